#pragma once

#include "dem/simulation/simulation.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

namespace bergamo::benchmark
{

enum class GrainKind
{
  superquadrics, ///< Leighton Buzzard sand, the defaults of dem/packing/distribution.h
  spheres        ///< of the same volumes
};

std::string name(GrainKind kind);

/// What is packed between six walls.
struct PackingRecipe
{
  GrainKind kind = GrainKind::superquadrics;
  int n_grains = 4000;
  double pressure = 25e3; ///< isotropic [Pa]
  std::uint64_t seed = 1;
};

/// State of a packing; call it after a step.
struct PackingFigures
{
  double solid_fraction = 0.;
  double coordination_number = 0.; ///< contacts between grains * 2 / grains
  double unbalanced_force = 0.;    ///< mean resultant over mean contact force
  double pressure = 0.;            ///< mean of the walls' [Pa]
};

PackingFigures packing_figures(const dem::Simulation &simulation);

/// Parameters of the settled sand: 50 GPa, friction 0.24 between grains, damping ratio 0.9.
dem::SimulationParameters sand_parameters();

/// Packs and settles grains; at the end the walls stand, and the time step is `step_share` of the stable one.
/// @param log is given a line at each stage
/// @throws RunError if the packing does not come to rest or hardly has contacts
std::unique_ptr<dem::Simulation> settle_packing(const PackingRecipe &recipe,
                                                const std::function<void(const std::string &)> &log);

constexpr double step_share = 0.3; ///< time step over the stable one

} // namespace bergamo::benchmark
