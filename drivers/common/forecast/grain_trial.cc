#include "drivers/common/forecast/grain_trial.h"

#include "dem/loading/cell_room.h"
#include "dem/state/repeated.h"
#include "drivers/common/forecast/step_trial.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace bergamo::driver
{

namespace
{

constexpr double loose = 0.55, dense = 0.6; // solid fractions, as it is packed and as it is tried
constexpr double most_packed = 400;         // grains: packing takes longer than trying
constexpr double most_tried = 4000;         // beyond, a grain costs the same
constexpr std::uint64_t seed_of_trial = 1;

} // namespace

GrainTrial::GrainTrial(const GradingParameters &sizes, const double solid_volume, const std::uint64_t seed)
    : sizes(sizes), drawn(sizes.draw(solid_volume, seed))
{
}

dem::Particles GrainTrial::packing(const double density) const
{
  const double volume = std::accumulate(drawn.volume.begin(), drawn.volume.end(), 0.) / n_grains();
  const double n_packed = std::clamp(n_grains(), 100., most_packed);
  constexpr double verlet_distance = 0.2, margin = 1.05;
  const double edge = std::max(std::cbrt(n_packed * volume / loose),
                               margin * dem::least_uncompressed_edge(drawn, loose, verlet_distance));
  dem::PackingParameters parameters;
  parameters.solid_fraction = loose;
  parameters.density = density;
  const auto space = dem::PackingSpace::periodic({Vec3::Zero(), Vec3::Constant(edge)});
  GradingParameters plain = sizes; // clumps cannot be packed so densely
  plain.shape = ShapeKind::superquadrics;
  dem::Particles packed = plain.pack(space, parameters, seed_of_trial).particles;
  const double shrinking = std::cbrt(loose / dense); // into contact
  for (Vec3 &place : packed.position)
    place *= shrinking;
  packed.cell = dem::PeriodicCell(Vec3::Constant(shrinking * edge));
  const double n_copies = std::min(n_grains(), most_tried) / static_cast<double>(packed.size());
  const int n_along = std::max(1, static_cast<int>(std::round(std::cbrt(n_copies))));
  return dem::repeated(packed, {{n_along, n_along, n_along}});
}

double GrainTrial::seconds_of_step(const dem::SimulationParameters &parameters)
{
  dem::SimulationParameters p = parameters;
  p.gravity = Vec3::Zero();
  p.time_step = 1e-12; // s, for the first one: nothing moves until it is known what is stable
  dem::Simulation simulation(p, packing(p.grain().density), {});
  simulation.compute_forces();
  tried_pressure = std::abs(simulation.cell_stress().mean());
  tried_stable_step = simulation.stable_time_step();
  constexpr double margin = 0.1; // so that grains move as little as in a packing at rest
  p.time_step = margin * tried_stable_step;
  simulation.integrate();
  simulation.change(p);
  const double n_tried = static_cast<double>(simulation.particles.size());
  const double seconds = seconds_of(
      [&]
      {
        simulation.step();
        simulation.rest(); // it stays the packing that it is
      });
  // Every part of a clump counts as a grain of its own: some of them touch less, and all are smaller.
  const double parts_per_grain = static_cast<double>(drawn.parts.size()) / n_grains();
  contacts_per_grain = simulation.contacts.n_touching() / n_tried;
  return parts_per_grain * seconds * n_grains() / n_tried;
}

double GrainTrial::stable_step(const double pressure) const
{
  return tried_stable_step * std::pow(tried_pressure / pressure, 1. / 6.);
}

} // namespace bergamo::driver
