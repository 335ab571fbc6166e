#include "dem/packing/pack_grains.h"

#include "dem/core/error.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace bergamo::dem
{
namespace
{

constexpr double solid_fraction_tolerance = 0.001;
constexpr double largest_added = 0.35; ///< solid fraction of a random addition

Superquadric scaled(Superquadric grain, const double factor)
{
  grain.half_axes *= factor;
  return grain;
}

Clump scaled(const Clump &grain, const double factor)
{
  return grain.scaled(factor);
}

template <class Grain>
std::vector<Grain> scaled(const std::vector<Grain> &grains, const double factor)
{
  std::vector<Grain> others;
  others.reserve(grains.size());
  for (const Grain &grain : grains)
    others.push_back(scaled(grain, factor));
  return others;
}

/// The factor that makes up for the part of a grain that is missing or too much.
template <class Grain>
double size_factor(const std::vector<Grain> &grains, const double solid_volume)
{
  constexpr double largest_change = 0.01;
  double total_volume = 0.;
  for (const Grain &grain : grains)
    total_volume += volume(grain);
  const double factor = std::cbrt(solid_volume / total_volume);
  if (std::abs(factor - 1.) > largest_change)
  {
    std::ostringstream message;
    message << "solid volume of the packing is " << solid_volume << " m^3: it must be large enough for whole grains of "
            << "the grading to make it up, " << grains.size() << " would have to change their size by "
            << 100. * (factor - 1.) << " %; choose a larger space or smaller grains";
    throw ConfigError(message.str());
  }
  return factor;
}

} // namespace

void PackingParameters::validate() const
{
  require(solid_fraction > 0. && solid_fraction <= 0.7, "solid fraction of the packing", solid_fraction,
          "in (0, 0.7]; denser packings come from compression by the DEM");
  require(start_solid_fraction > 0. && start_solid_fraction <= largest_added, "solid fraction of the random addition",
          start_solid_fraction, "in (0, 0.35]");
  require(density > 0. && std::isfinite(density), "density of the grains", density, "positive [kg/m^3]");
  tightening.validate();
}

void PackingParameters::validate_for_clumps() const
{
  require(solid_fraction <= largest_added, "solid fraction of a packing of clumps", solid_fraction,
          "in (0, 0.35]: clumps are placed at random and not tightened; the compression by the DEM makes them dense");
}

double PackingReport::trials_per_grain() const
{
  double n_trials = 0., n_placed = 0.;
  for (const AdditionRound &round : addition)
  {
    n_trials += round.n_tried;
    n_placed += round.n_placed;
  }
  return n_placed > 0. ? n_trials / n_placed : 0.;
}

PackedGrains pack_grains(const Grading &grading, const PackingSpace &space, const PackingParameters &parameters,
                         const std::uint64_t seed)
{
  parameters.validate();
  std::mt19937_64 generator(seed);
  const double solid_volume = parameters.solid_fraction * space.volume();
  std::vector<Superquadric> grains = draw_grains(grading, solid_volume, generator);
  PackedGrains packed;
  PackingReport &report = packed.report;
  report.size_factor = size_factor(grains, solid_volume);
  grains = scaled(grains, report.size_factor);
  double largest = 0.;
  for (const Superquadric &grain : grains)
    largest = std::max(largest, bounding_radius(grain));
  space.require_range(tightening_range(largest));

  LoosePacking loose;
  loose.size = std::min(1., std::cbrt(parameters.start_solid_fraction / parameters.solid_fraction));
  RandomAddition addition = place_at_random(scaled(grains, loose.size), space, generator());
  loose.places = std::move(addition.places);
  report.addition = std::move(addition.rounds);
  Tightening tight = tighten(grains, space, loose, parameters.tightening, generator());
  report.tightening = std::move(tight.steps);

  double solid = 0.;
  for (std::size_t i = 0; i < grains.size(); ++i)
  {
    Superquadric grain = grains[i];
    grain.half_axes *= tight.size[i];
    solid += volume(grain);
    report.smallest_size = std::min(report.smallest_size, tight.size[i]);
    packed.particles.add(grain, parameters.density, tight.places.position[i], tight.places.orientation[i]);
  }
  report.solid_fraction = solid / space.volume();
  report.has_reached_target = std::abs(report.solid_fraction - parameters.solid_fraction) <= solid_fraction_tolerance;
  return packed;
}

PackedGrains pack_clumps(const ClumpGrading &grading, const PackingSpace &space, const PackingParameters &parameters,
                         const std::uint64_t seed)
{
  parameters.validate();
  parameters.validate_for_clumps();
  std::mt19937_64 generator(seed);
  const double solid_volume = parameters.solid_fraction * space.volume();
  std::vector<Clump> grains = draw_clumps(grading, solid_volume, generator);
  PackedGrains packed;
  PackingReport &report = packed.report;
  report.size_factor = size_factor(grains, solid_volume);
  grains = scaled(grains, report.size_factor);
  RandomAddition addition = place_at_random(grains, space, generator());
  report.addition = std::move(addition.rounds);
  double solid = 0.;
  for (std::size_t i = 0; i < grains.size(); ++i)
  {
    solid += grains[i].volume();
    packed.particles.add(grains[i], parameters.density, addition.places.position[i], addition.places.orientation[i]);
  }
  report.solid_fraction = solid / space.volume();
  return packed;
}

} // namespace bergamo::dem
