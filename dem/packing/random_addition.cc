#include "dem/packing/random_addition.h"

#include "dem/core/error.h"
#include "dem/core/parallel.h"
#include "dem/packing/distribution.h"
#include "dem/packing/grain_grid.h"
#include "dem/packing/grain_parts.h"
#include "dem/packing/random_stream.h"

#include <algorithm>
#include <cmath>
#include <limits>
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
  GrainPlace place;
  bool fits = false;                ///< between the walls and the placed grains
  std::vector<std::int32_t> rivals; ///< trials of larger grains that it would overlap
};

class Addition
{
public:
  Addition(const GrainParts &grains, const PackingSpace &space, const std::uint64_t seed)
      : grains(grains), space(space), seed(seed), grid(space, range()), trial_grid(space, range())
  {
    space.require_range(range());
    require_room();
    result.places.position.resize(grains.size());
    result.places.orientation.resize(grains.size());
    remaining.resize(grains.size());
    std::iota(remaining.begin(), remaining.end(), 0);
    std::stable_sort(remaining.begin(), remaining.end(),
                     [&](const auto i, const auto j) { return grains.bounding_radius(i) > grains.bounding_radius(j); });
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

  double range() const { return grains.size() == 0 ? 1. : 2. * grains.largest_bounding_radius(); }

  /// A grain is at least as wide as a sphere inside it in every direction.
  void require_room() const
  {
    double edge = std::numeric_limits<double>::infinity();
    for (int d = 0; d < 3; ++d)
      if (!space.is_periodic(d)) // else require_range() has asked for more
        edge = std::min(edge, space.bounds().edges()[d]);
    const double widest = 2. * grains.largest_inscribed_radius();
    if (widest < edge)
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
        trial_grid.add(static_cast<std::int32_t>(k), trials[k].place.position, grains.bounding_radius(remaining[k]));
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
      result.places.position[remaining[k]] = t.place.position;
      result.places.orientation[remaining[k]] = t.place.orientation;
      grid.add(remaining[k], t.place.position, grains.bounding_radius(remaining[k]));
    }
    left.insert(left.end(), remaining.begin() + n_tried, remaining.end());
    remaining.swap(left);
  }

  Trial draw(const std::int32_t i) const
  {
    RandomStream random(seed, result.rounds.size(), i);
    Trial t;
    for (int d = 0; d < 3; ++d)
      t.place.position[d] = random.uniform(space.bounds().low[d], space.bounds().high[d]);
    const double u = random.uniform(), v = random.uniform(), w = random.uniform();
    t.place.orientation = uniform_rotation(u, v, w);
    // The spheres first: they decide most trials.
    bool is_free = true;
    std::vector<std::pair<std::int32_t, Vec3>> near;
    grid.any_near(t.place.position, grains.bounding_radius(i),
                  [&](const std::int32_t j, const Vec3 &centre_line)
                  {
                    const double closest = grains.core_radius(i) + grains.core_radius(j);
                    is_free = centre_line.squaredNorm() > closest * closest;
                    near.emplace_back(j, centre_line);
                    return !is_free;
                  });
    if (!is_free)
      return t;
    const auto is_apart = [&](const auto &other)
    {
      const auto &[j, centre_line] = other;
      return grains.are_apart(i, t.place, j, {result.places.position[j], result.places.orientation[j]}, centre_line);
    };
    t.fits = grains.is_inside(space, i, t.place) && std::all_of(near.begin(), near.end(), is_apart);
    return t;
  }

  void find_rivals(const std::int32_t k)
  {
    Trial &t = trials[k];
    if (!t.fits)
      return;
    const std::int32_t i = remaining[k];
    trial_grid.any_near(t.place.position, grains.bounding_radius(i),
                        [&](const std::int32_t r, const Vec3 &centre_line)
                        {
                          if (r < k && !grains.are_apart(i, t.place, remaining[r], trials[r].place, centre_line))
                            t.rivals.push_back(r);
                          return false;
                        });
  }

  [[noreturn]] void give_up() const
  {
    double placed_volume = 0.;
    for (std::size_t i = 0; i < grains.size(); ++i)
      placed_volume += grains.volume(i);
    for (const std::int32_t i : remaining)
      placed_volume -= grains.volume(i);
    std::ostringstream message;
    message << "the packing does not fit: " << remaining.size() << " of " << grains.size()
            << " grains found no place in the space of " << space.bounds().edges().transpose()
            << " m, the solid fraction reached is " << placed_volume / space.volume()
            << "; choose a larger space, smaller grains or a smaller initial solid fraction (0.22 works)";
    throw ConfigError(message.str());
  }

  const GrainParts &grains;
  const PackingSpace &space;
  std::uint64_t seed;
  GrainGrid grid, trial_grid;
  std::vector<std::int32_t> remaining; // large ones first
  std::vector<Trial> trials;           // of the remaining grains
  RandomAddition result;
};

template <class Grain>
Particles add_any_at_random(const std::span<const Grain> grains, const PackingSpace &space, const double density,
                            const std::uint64_t seed)
{
  require(density > 0. && std::isfinite(density), "density of the grains", density, "positive [kg/m^3]");
  const GrainPlaces places = place_at_random(grains, space, seed).places;
  Particles particles;
  for (std::size_t i = 0; i < grains.size(); ++i)
    particles.add(grains[i], density, places.position[i], places.orientation[i]);
  return particles;
}

} // namespace

RandomAddition place_at_random(const std::span<const Superquadric> grains, const PackingSpace &space,
                               const std::uint64_t seed)
{
  return Addition(GrainParts(grains), space, seed).run();
}

RandomAddition place_at_random(const std::span<const Clump> grains, const PackingSpace &space, const std::uint64_t seed)
{
  return Addition(GrainParts(grains), space, seed).run();
}

Particles add_at_random(const std::span<const Superquadric> grains, const PackingSpace &space, const double density,
                        const std::uint64_t seed)
{
  return add_any_at_random(grains, space, density, seed);
}

Particles add_at_random(const std::span<const Clump> grains, const PackingSpace &space, const double density,
                        const std::uint64_t seed)
{
  return add_any_at_random(grains, space, density, seed);
}

} // namespace bergamo::dem
