#include "dem/packing/random_addition.h"

#include "dem/core/error.h"
#include "dem/core/parallel.h"
#include "dem/packing/distribution.h"
#include "dem/packing/grain_grid.h"
#include "dem/packing/overlap.h"
#include "dem/packing/random_stream.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>
#include <utility>
#include <vector>

namespace bergamo::dem
{
namespace
{

struct Trial
{
  Vec3 position;
  Quaternion orientation;
  bool fits = false;                ///< between the walls and the placed grains
  std::vector<std::int32_t> rivals; ///< trials of larger grains that it would overlap
};

class Addition
{
public:
  Addition(const std::span<const Superquadric> grains, const PackingSpace &space, const std::uint64_t seed)
      : grains(grains), space(space), seed(seed), radius(each(grains, bounding_radius)),
        inscribed(each(grains, inscribed_radius)), grid(space, range()), trial_grid(space, range())
  {
    space.require_range(range());
    require_room();
    result.places.position.resize(grains.size());
    result.places.orientation.resize(grains.size());
    remaining.resize(grains.size());
    std::iota(remaining.begin(), remaining.end(), 0);
    std::stable_sort(remaining.begin(), remaining.end(),
                     [&](const auto i, const auto j) { return radius[i] > radius[j]; });
  }

  RandomAddition run()
  {
    std::int64_t n_trials = 0, n_placed = 0;
    while (!remaining.empty())
    {
      const std::size_t before = remaining.size(),
                        n_tried = std::min(before, std::max(least_tried, grains.size() / 20));
      place_round(n_tried);
      const AdditionRound round{static_cast<std::int32_t>(n_tried),
                                static_cast<std::int32_t>(before - remaining.size())};
      result.rounds.push_back(round);
      n_trials += round.n_tried;
      n_placed += round.n_placed;
      if (!remaining.empty() && n_trials > first_trials + trials_per_grain * n_placed)
        give_up();
    }
    return std::move(result);
  }

private:
  static constexpr std::size_t least_tried = 50;                                // in a round
  static constexpr std::int64_t first_trials = 100000, trials_per_grain = 1000; // before the addition gives up

  static std::vector<double> each(const std::span<const Superquadric> grains,
                                  double (*const measure)(const Superquadric &))
  {
    std::vector<double> values(grains.size());
    parallel_for(grains.size(), [&](const std::size_t i) { values[i] = measure(grains[i]); });
    return values;
  }

  PlacedGrain at(const std::int32_t i, const Vec3 &position, const Quaternion &orientation) const
  {
    return {grains[i], make_pose(grains[i], position, orientation), radius[i], inscribed[i]};
  }

  double range() const { return radius.empty() ? 1. : 2. * *std::max_element(radius.begin(), radius.end()); }

  /// A grain is at least as wide as its inscribed sphere in every direction.
  void require_room() const
  {
    const double edge = space.bounds().edges().minCoeff();
    const double widest = inscribed.empty() ? 0. : 2. * *std::max_element(inscribed.begin(), inscribed.end());
    if (widest < edge || space.is_periodic())
      return;
    std::ostringstream message;
    message << "shortest edge of the packing's space is " << edge << " m: it must be larger than the narrowest side of "
            << "every grain, up to " << widest << " m; choose a larger space or smaller grains";
    throw ConfigError(message.str());
  }

  void place_round(const std::size_t n_tried)
  {
    trials.assign(n_tried, {});
    parallel_for(trials.size(), [&](const std::size_t k) { trials[k] = draw(remaining[k]); });
    trial_grid.clear();
    for (std::size_t k = 0; k < trials.size(); ++k)
      if (trials[k].fits)
        trial_grid.add(static_cast<std::int32_t>(k), trials[k].position, radius[remaining[k]]);
    parallel_for(trials.size(), [&](const std::size_t k) { find_rivals(static_cast<std::int32_t>(k)); });

    std::vector<std::int32_t> left;
    for (std::size_t k = 0; k < trials.size(); ++k)
    {
      Trial &t = trials[k];
      t.fits = t.fits && std::none_of(t.rivals.begin(), t.rivals.end(), [&](const auto r) { return trials[r].fits; });
      if (!t.fits)
      {
        left.push_back(remaining[k]);
        continue;
      }
      result.places.position[remaining[k]] = t.position;
      result.places.orientation[remaining[k]] = t.orientation;
      grid.add(remaining[k], t.position, radius[remaining[k]]);
    }
    left.insert(left.end(), remaining.begin() + n_tried, remaining.end());
    remaining.swap(left);
  }

  Trial draw(const std::int32_t i) const
  {
    RandomStream random(seed, result.rounds.size(), i);
    Trial t;
    for (int d = 0; d < 3; ++d)
      t.position[d] = random.uniform(space.bounds().low[d], space.bounds().high[d]);
    const double u = random.uniform(), v = random.uniform(), w = random.uniform();
    t.orientation = uniform_rotation(u, v, w);
    // The spheres first: they decide most trials.
    bool is_free = true;
    std::vector<std::pair<std::int32_t, Vec3>> near;
    grid.any_near(t.position, radius[i],
                  [&](const std::int32_t j, const Vec3 &centre_line)
                  {
                    const double closest = inscribed[i] + inscribed[j];
                    is_free = centre_line.squaredNorm() > closest * closest;
                    near.emplace_back(j, centre_line);
                    return !is_free;
                  });
    if (!is_free)
      return t;
    const PlacedGrain grain = at(i, t.position, t.orientation);
    const auto is_apart = [&](const auto &other)
    {
      const auto &[j, centre_line] = other;
      return are_apart(grain, at(j, result.places.position[j], result.places.orientation[j]), centre_line);
    };
    t.fits = space.contains(grain.pose, radius[i]) && std::all_of(near.begin(), near.end(), is_apart);
    return t;
  }

  void find_rivals(const std::int32_t k)
  {
    Trial &t = trials[k];
    if (!t.fits)
      return;
    const PlacedGrain grain = at(remaining[k], t.position, t.orientation);
    trial_grid.any_near(
        t.position, radius[remaining[k]],
        [&](const std::int32_t r, const Vec3 &centre_line)
        {
          if (r < k && !are_apart(grain, at(remaining[r], trials[r].position, trials[r].orientation), centre_line))
            t.rivals.push_back(r);
          return false;
        });
  }

  [[noreturn]] void give_up() const
  {
    double placed_volume = 0.;
    for (const Superquadric &grain : grains)
      placed_volume += volume(grain);
    for (const std::int32_t i : remaining)
      placed_volume -= volume(grains[i]);
    std::ostringstream message;
    message << "the packing does not fit: " << remaining.size() << " of " << grains.size()
            << " grains found no place in the space of " << space.bounds().edges().transpose()
            << " m, the solid fraction reached is " << placed_volume / space.volume()
            << "; choose a larger space, smaller grains or a smaller initial solid fraction (0.22 works)";
    throw ConfigError(message.str());
  }

  std::span<const Superquadric> grains;
  const PackingSpace &space;
  std::uint64_t seed;
  std::vector<double> radius, inscribed; // [m]
  GrainGrid grid, trial_grid;
  std::vector<std::int32_t> remaining; // large ones first
  std::vector<Trial> trials;           // of the remaining grains
  RandomAddition result;
};

} // namespace

RandomAddition place_at_random(const std::span<const Superquadric> grains, const PackingSpace &space,
                               const std::uint64_t seed)
{
  for (const Superquadric &grain : grains)
    grain.validate();
  return Addition(grains, space, seed).run();
}

Particles add_at_random(const std::span<const Superquadric> grains, const PackingSpace &space, const double density,
                        const std::uint64_t seed)
{
  require(density > 0. && std::isfinite(density), "density of the grains", density, "positive [kg/m^3]");
  const GrainPlaces places = place_at_random(grains, space, seed).places;
  Particles particles;
  for (std::size_t i = 0; i < grains.size(); ++i)
    particles.add(grains[i], density, places.position[i], places.orientation[i]);
  return particles;
}

} // namespace bergamo::dem
