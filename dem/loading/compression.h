#pragma once

#include "dem/packing/random_addition.h"
#include "dem/simulation/simulation.h"

#include <vector>

namespace bergamo::dem
{

/// Six rigid walls of a box in the order x-, x+, y-, y+, z-, z+.
std::vector<PlaneWall> box_walls(const Box &box);

/// The box between the first six walls of a simulation, at its present step.
Box box_between(const std::vector<PlaneWall> &walls);

/// Pressure on the walls of a box per direction, mean of both faces, compression positive [Pa].
Vec3 wall_pressure(const std::vector<PlaneWall> &walls);

/// How a packing is compressed.
struct CompressionParameters
{
  double pressure = 1000.;   ///< aimed at in every direction [Pa]
  double largest_rate = 40.; ///< strain rate of the walls [1/s]
  double pressure_tolerance = 0.01;
  double force_tolerance = 0.01; ///< mean unbalanced over mean contact force
  double longest_time = 0.5;     ///< [s]

  /// Throws ConfigError for a value out of its range.
  void validate() const;
};

/// Compresses the grains of a box between its six walls to a given isotropic pressure. The walls of a direction are
/// pistons that move in opposition: pushed by what the pressure misses, braked by a dashpot that takes up a part of the
/// waves which reach them. Pistons only take energy out but for the work of the pressure, so they come to rest with any
/// stiffness, size, density and damping of the grains and with any time step that the contacts bear; a speed set by the
/// miss over the stiffness of a wall's contacts would shake where steps are short, as their dashpots then answer it
/// with more than the miss. No wall is faster than the pressure could push the grains, sqrt(p/rho)/2.
class Compression
{
public:
  explicit Compression(const CompressionParameters &parameters);

  /// One step of the simulation, walls included. @throws RunError after the longest time
  void step(Simulation &simulation);

  /// All pressures hold and the grains rest.
  bool is_finished() const { return n_checks_passed >= checks_needed; }

  double n_checks_passed = 0.; ///< in a row
  double unbalance = 1.;       ///< of the last check, see unbalanced_force()

  template <class Self, class Visit>
  static void visit_state(Self &self, Visit &visit)
  {
    visit("n_checks_passed", self.n_checks_passed);
    visit("unbalance", self.unbalance);
  }

private:
  static constexpr double checks_needed = 5.;

  CompressionParameters p;
};

/// Mean resultant of the grains that have contacts over the mean contact force: 0 in perfect rest.
double unbalanced_force(const Simulation &simulation);

} // namespace bergamo::dem
