#pragma once

#include "dem/packing/distribution.h"

#include <random>
#include <variant>
#include <vector>

namespace bergamo::dem
{

/// Random shapes before they get their size: half-axes uniform in [1, elongation], exponents uniform in
/// [1 - angularity, 1 + angularity] (Wellmann 3.4.4).
struct GrainShapes
{
  double elongation = 1.5; ///< largest ratio of two half-axes, >= 1
  double angularity = 0.3; ///< largest distance of an exponent from 1, in [0, 1)

  /// Throws ConfigError for a value out of its range.
  void validate() const;
};

/// Diameters of the spheres of equal volume, uniform by number between two bounds (Wellmann 3.4.4).
struct UniformSizes
{
  double smallest_diameter = 0.5e-3, largest_diameter = 1e-3; ///< [m]
  GrainShapes shapes;

  /// Throws ConfigError for a value out of its range.
  void validate() const;
};

/// One sieve: the share of the mass that passes openings of a size.
struct SievePoint
{
  double size = 0.;    ///< [m]
  double passing = 0.; ///< in [0, 1]
};

/// Sizes by mass, as sieving gives them. The size of a grain is its intermediate diameter. Between the points the
/// passing share is linear in the logarithm of the size; it begins at 0 and ends at 1.
struct SieveCurve
{
  std::vector<SievePoint> points; ///< ascending; the first passes 0, the last 1
  GrainShapes shapes;

  /// The curve through 10 %, 50 % and 60 % by mass; its lowest part goes on to 0, its highest part to 1, straight in
  /// the logarithm of the size: smallest = d10 (d10/d50)^(1/4), largest = d60 (d60/d50)^4. Throws ConfigError unless 0
  /// < d10 < d50 < d60 [m].
  static SieveCurve through(double d10, double d50, double d60, const GrainShapes &shapes = {});

  /// Throws ConfigError for points that do not ascend or do not lead from 0 to 1.
  void validate() const;
};

/// The sizes and shapes of a sand.
using Grading = std::variant<GrainDistribution, UniformSizes, SieveCurve>;

/// One random grain. By number: of a sieve curve the small ones are as frequent as their share of the mass asks for.
Superquadric draw_grain(const UniformSizes &sizes, std::mt19937_64 &generator);
Superquadric draw_grain(const SieveCurve &curve, std::mt19937_64 &generator);

/// Grains until their volume reaches solid_volume [m^3] as nearly as whole grains can. Throws ConfigError for a grading
/// or a volume out of its range.
std::vector<Superquadric> draw_grains(const Grading &grading, double solid_volume, std::mt19937_64 &generator);

/// Intermediate diameter of a grain, the opening that it passes [m].
double sieve_size(const Superquadric &grain);

} // namespace bergamo::dem
