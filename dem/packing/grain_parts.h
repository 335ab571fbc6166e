#pragma once

#include "dem/geometry/rigid_clump.h"
#include "dem/packing/overlap.h"
#include "dem/packing/space.h"

#include <cstdint>
#include <span>
#include <vector>

namespace bergamo::dem
{

/// Where a grain lies.
struct GrainPlace
{
  Vec3 position;          ///< centre of mass [m]
  Quaternion orientation; ///< principal frame to global
};

/// Grains to be packed, each of one part or several, with what decides about overlaps at little cost.
class GrainParts
{
public:
  /// Throws ConfigError for impossible shapes.
  explicit GrainParts(std::span<const Superquadric> grains);
  explicit GrainParts(std::span<const Clump> grains);

  std::size_t size() const { return grain_volume.size(); } ///< grains
  double volume(const std::size_t i) const { return grain_volume[i]; }
  double bounding_radius(const std::size_t i) const { return radius[i]; } ///< about the centre of mass [m]

  /// Of a sphere about the centre of mass that lies inside the grain [m]; 0 where there is none.
  double core_radius(const std::size_t i) const { return core[i]; }

  /// Of the largest sphere inside any part: no grain is narrower than that of its own [m].
  double largest_inscribed_radius() const;
  double largest_bounding_radius() const;

  /// Whether a grain lies inside all walls of a space.
  bool is_inside(const PackingSpace &space, std::size_t i, const GrainPlace &place) const;

  /// Whether each part of a grain is known to be apart from each part of another one; see are_apart() of two parts.
  /// @param centre_line from the centre of mass of the first to that of the second, or to an image of it [m]
  bool are_apart(std::size_t i, const GrainPlace &place_i, std::size_t j, const GrainPlace &place_j,
                 const Vec3 &centre_line) const;

private:
  void measure();
  PlacedGrain part(std::size_t k, const Vec3 &arm, const GrainPlace &grain) const;

  std::vector<double> grain_volume, radius, core;
  std::vector<std::int32_t> first_part{0}; // parts of grain i: first_part[i] .. first_part[i + 1]
  std::vector<Superquadric> shape;
  std::vector<Vec3> place;      // in the grain's frame [m]
  std::vector<Quaternion> turn; // part to grain
  std::vector<double> part_radius, inscribed;
};

} // namespace bergamo::dem
