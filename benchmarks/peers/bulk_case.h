#pragma once

#include "benchmarks/peers/track.h"
#include "dem/simulation/simulation_parameters.h"
#include "dem/state/particles.h"
#include "dem/state/surface.h"

#include <cstdint>
#include <functional>
#include <limits>
#include <string>

namespace bergamo::benchmark
{

/// Numbers of the materials of every case in its table.
constexpr std::int32_t material_1 = dem::grain_material, steel = dem::wall_material, material_2 = 2;

/// Materials, frictions, restitution and gravity of Dosta et al. (2024), Comput. Phys. Commun. 109066. Their
/// coefficients of restitution become the damping ratios of Bergamo's dashpot, which hold at any speed.
/// @param softening divides the moduli of both materials of the beads, 1 or more
dem::SimulationParameters bulk_parameters(double softening);

/// What a case is judged by: a number for each moment.
struct BulkMeasure
{
  std::string name, unit;
  std::function<double(const Frame &)> of;
};

/// Spheres in a vessel of triangles: all that a program needs to know to run it.
struct BulkCase
{
  std::string name;
  dem::SimulationParameters parameters;
  dem::Particles beads;                                     ///< spheres as they start; ids 0, 1, ..
  dem::Surface vessel;                                      ///< triangles as they start, of steel
  double vessel_spin = 0.;                                  ///< about the y axis, by the right hand [1/s]
  double outlet = -std::numeric_limits<double>::infinity(); ///< beads with lower centres are taken out now and then [m]
  std::int64_t steps_between_samples = 1;
  int n_samples = 1;            ///< beside the one at the start
  double developed = 0.;        ///< time by which beads move as they will, for the timing [s]
  std::int64_t only_bead = all; ///< whose places are wanted
  BulkMeasure measure;

  static constexpr std::int64_t all = -1;
  std::int64_t n_steps() const { return steps_between_samples * n_samples; }
};

/// Mean of the beads' radii [m].
double mean_radius(const BulkCase &bulk);

/// Angular velocity of a bead [1/s].
Vec3 spin_of(const dem::Particles &beads, std::size_t i);

/// The case with all beads moved by some nanometres at random: what becomes of that is the scatter that two programs
/// may have between them. @param seed of the motions
BulkCase perturbed(BulkCase bulk, std::uint64_t seed);

} // namespace bergamo::benchmark
