#include "dem/packing/tightening.h"

#include "dem/core/error.h"
#include "dem/core/parallel.h"
#include "dem/core/rows.h"
#include "dem/geometry/orientation.h"
#include "dem/packing/gap_search.h"
#include "dem/packing/grain_grid.h"
#include "dem/packing/grain_move.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <string>

namespace bergamo::dem
{
namespace
{

constexpr double margin_share = 0.4; // of the mean bounding radius: pairs that are further apart are not listed

Superquadric scaled(const Superquadric &shape, const double size)
{
  return {size * shape.half_axes, shape.eps1, shape.eps2};
}

/// All grains with what lies between them.
class Tightener
{
public:
  Tightener(const std::span<const Superquadric> grains, const PackingSpace &space, const LoosePacking &start,
            const TighteningParameters &parameters, const std::uint64_t seed)
      : grains(grains), space(space), p(parameters), seed(seed)
  {
    const std::size_t n = grains.size();
    result.places = start.places;
    result.size.assign(n, start.size);
    radius.resize(n);
    volumes.resize(n);
    poses.resize(n, make_pose(Superquadric(), Vec3::Zero(), Quaternion::Identity()));
    surface_motion.resize(n);
    sphere_motion.resize(n);
    path.assign(n, 0.);
    parallel_for(n,
                 [&](const std::size_t i)
                 {
                   radius[i] = bounding_radius(grains[i]);
                   volumes[i] = volume(grains[i]);
                   renew_pose(i);
                 });
    largest = *std::max_element(radius.begin(), radius.end());
    mean_radius = std::accumulate(radius.begin(), radius.end(), 0.) / n;
    list_margin = margin_share * mean_radius;
    space.require_range(tightening_range(largest));
    measure();
  }

  Tightening run()
  {
    while (now.smallest_size < 1. && static_cast<int>(result.steps.size()) < p.max_iterations && !is_stuck() &&
           !(p.is_stopped && p.is_stopped()))
    {
      advance();
      measure();
      result.steps.push_back(now);
    }
    return std::move(result);
  }

private:
  bool is_stuck() const
  {
    const auto &steps = result.steps;
    return steps.size() > patience && now.mean_size - steps[steps.size() - patience].mean_size < least_growth;
  }

  void renew_pose(const std::size_t i)
  {
    poses[i] = make_pose(scaled(grains[i], result.size[i]), result.places.position[i], result.places.orientation[i]);
  }

  void measure()
  {
    double solid = 0., sum = 0., smallest = 1.;
    for (std::size_t i = 0; i < grains.size(); ++i)
    {
      solid += volumes[i] * result.size[i] * result.size[i] * result.size[i];
      sum += result.size[i];
      smallest = std::min(smallest, result.size[i]);
    }
    now = {solid / space.volume(), sum / grains.size(), smallest};
  }

  void advance()
  {
    // Half of the room that the list leaves: it holds for two iterations at least.
    longest_motion = motion_share * mean_radius;
    if (pairs.empty() || *std::max_element(path.begin(), path.end()) + longest_motion > 0.5 * list_margin)
      list_pairs();
    search();
    full_size = std::min(1., now.mean_size * (1. + p.size_step));
    parallel_for(grains.size(), [&](const std::size_t i) { move(i); });
    parallel_for(grains.size(), [&](const std::size_t i) { renew_pose(i); });
    parallel_for(pairs.size(), [&](const std::size_t k)
                 { pairs[k].width -= surface_motion[pairs[k].first] + surface_motion[pairs[k].second]; });
    for (std::size_t i = 0; i < grains.size(); ++i)
      path[i] += sphere_motion[i];
  }

  /// Pairs whose bounding spheres are nearer than the margin, in the order of their grains; those known keep their
  /// plane.
  void list_pairs()
  {
    const std::size_t n = grains.size();
    GrainGrid grid(space, 2. * largest + list_margin);
    for (std::size_t i = 0; i < n; ++i)
      grid.add(static_cast<std::int32_t>(i), result.places.position[i], result.size[i] * radius[i]);
    Collected<GrainGap> found;
    parallel_ranges(n, 64,
                    [&](const std::size_t part, const std::size_t begin, const std::size_t end)
                    {
                      std::vector<std::int32_t> near;
                      for (std::size_t i = begin; i < end; ++i)
                      {
                        near.clear();
                        grid.any_near(result.places.position[i], result.size[i] * radius[i] + list_margin,
                                      [&](const std::int32_t j, const Vec3 &)
                                      {
                                        if (j > static_cast<std::int32_t>(i))
                                          near.push_back(j);
                                        return false;
                                      });
                        std::sort(near.begin(), near.end());
                        for (const std::int32_t j : near)
                          found.of(part).push_back(known(static_cast<std::int32_t>(i), j));
                      }
                    });
    pairs = found.all();
    first_of.assign(n + 1, 0);
    for (const GrainGap &pair : pairs)
      ++first_of[pair.first + 1];
    std::partial_sum(first_of.begin(), first_of.end(), first_of.begin());
    of_grain = {n, [&](const auto &put)
                {
                  for (std::size_t k = 0; k < pairs.size(); ++k)
                  {
                    put(pairs[k].first, static_cast<std::int64_t>(k));
                    put(pairs[k].second, static_cast<std::int64_t>(k));
                  }
                }};
    path.assign(n, 0.);
  }

  GrainGap known(const std::int32_t i, const std::int32_t j) const
  {
    if (!first_of.empty())
    {
      const auto begin = pairs.begin() + first_of[i], end = pairs.begin() + first_of[i + 1];
      const auto at =
          std::lower_bound(begin, end, j, [](const GrainGap &g, const std::int32_t k) { return g.second < k; });
      if (at != end && at->second == j)
        return *at;
    }
    return {i, j};
  }

  /// A pair rests until its grains may have come so near that they may meet within one iteration.
  bool is_near(const GrainGap &pair) const { return pair.width <= 2. * longest_motion; }

  void search()
  {
    Collected<GrainGap *> due;
    parallel_ranges(pairs.size(), 256,
                    [&](const std::size_t part, const std::size_t begin, const std::size_t end)
                    {
                      for (std::size_t k = begin; k < end; ++k)
                        if (is_near(pairs[k]))
                          due.of(part).push_back(&pairs[k]);
                    });
    const std::vector<GrainGap *> all = due.all();
    parallel_ranges(all.size(), 64,
                    [&](const std::size_t, const std::size_t begin, const std::size_t end)
                    {
                      std::vector<Vec3> lines;
                      for (std::size_t k = begin; k < end; ++k)
                        lines.push_back(
                            space.nearest_image(poses[all[k]->second].position - poses[all[k]->first].position));
                      search_gaps(std::span(all).subspan(begin, end - begin), poses, lines);
                    });
  }

  /// The planes a grain must stay below. @return false if one of its neighbours may not be separated from it
  bool find_planes(const std::size_t i, std::vector<TangentPlane> &planes) const
  {
    for (const std::int64_t k : of_grain[i])
    {
      const GrainGap &pair = pairs[k];
      if (!is_near(pair))
        continue;
      if (pair.width <= 0.)
        return false;
      if (pair.first == static_cast<std::int32_t>(i))
        planes.push_back({pair.normal, 0.5 * pair.width, pair.height1});
      else
        planes.push_back({-pair.normal, 0.5 * pair.width, pair.height2});
    }
    for (const HalfSpace &wall : space.walls())
    {
      const double distance = wall.offset - wall.normal.dot(poses[i].position);
      if (distance > result.size[i] * radius[i] + longest_motion)
        continue;
      const double height = support(poses[i], wall.normal).height;
      planes.push_back({wall.normal, distance - height, height});
    }
    if (const auto reach = space.curved_wall(poses[i]))
      planes.push_back(
          {reach->direction, space.curved_wall_radius() - reach->bound, support(poses[i], reach->direction).height});
    return true;
  }

  void move(const std::size_t i)
  {
    surface_motion[i] = sphere_motion[i] = 0.;
    std::vector<TangentPlane> planes;
    if (!find_planes(i, planes))
      return;
    const double reserve = 1e-9 * radius[i]; // rounding closes no gap
    for (TangentPlane &plane : planes)
      plane.room = std::max(0., plane.room - reserve);
    const double r = result.size[i] * radius[i];
    RandomStream random(seed, result.steps.size(), i);
    MoveLimits limits;
    limits.translation = 0.7 * longest_motion;
    limits.angle = std::min(0.25 * std::numbers::pi, 0.7 * longest_motion / r);
    limits.growth = std::clamp(full_size / result.size[i] - 1., 0., 0.3 * longest_motion / r);
    limits.translation_probability = p.translation_probability;
    const GrainMove chosen = choose_move(poses[i], planes, limits, random);
    const double grown = result.size[i] * (1. + chosen.growth);
    const double size = grown < full_size * (1. - 1e-12) ? grown : full_size; // exactly: all shall end at 1
    const Vec3 position = space.wrap(poses[i].position + chosen.translation);
    const Quaternion orientation = (chosen.rotation * result.places.orientation[i]).normalized();
    if (space.curved_wall_radius() > 0. &&
        !space.contains(make_pose(scaled(grains[i], size), position, orientation), size * radius[i]))
      return;
    const double growth = (size - result.size[i]) * radius[i];
    sphere_motion[i] = chosen.translation.norm() + growth;
    surface_motion[i] = sphere_motion[i] + Eigen::AngleAxisd(chosen.rotation).angle() * r;
    result.places.position[i] = position;
    result.places.orientation[i] = orientation;
    result.size[i] = std::max(size, result.size[i]);
  }

  static constexpr std::size_t patience = 200; // iterations
  static constexpr double least_growth = 1e-4; // of the mean size in so many
  static constexpr double motion_share = 0.1;

  std::span<const Superquadric> grains;
  const PackingSpace &space;
  TighteningParameters p;
  std::uint64_t seed;
  std::vector<double> radius, volumes; // at full size [m], [m^3]
  double largest = 0., mean_radius = 0., list_margin = 0., longest_motion = 0., full_size = 1.;
  std::vector<BodyPose> poses;        // at the present size
  std::vector<double> surface_motion; // of any point, in this iteration [m]
  std::vector<double> sphere_motion;  // of the bounding sphere [m]
  std::vector<double> path;           // of the bounding sphere since the list was made [m]
  std::vector<GrainGap> pairs;
  std::vector<std::int64_t> first_of; // pairs[first_of[i]] .. are those whose first grain is i
  Rows<std::int64_t> of_grain;        // pairs of each grain
  TighteningStep now;
  Tightening result;
};

} // namespace

double tightening_range(const double largest_radius)
{
  return (2. + margin_share) * largest_radius;
}

void TighteningParameters::validate() const
{
  require(size_step >= 1e-4 && size_step <= 0.1, "size step of the tightening", size_step, "in [0.0001, 0.1]");
  require(translation_probability >= 0. && translation_probability <= 1., "probability of a translation",
          translation_probability, "in [0, 1]");
  require(max_iterations > 0, "largest number of iterations of the tightening", max_iterations, "positive");
}

void LoosePacking::validate(const std::size_t n_grains) const
{
  require(size > 0. && size <= 1., "size of the grains of the loose packing over their full size", size, "in (0, 1]");
  for (const std::size_t n : {places.position.size(), places.orientation.size()})
    require(n == n_grains, "number of places of the loose packing", static_cast<double>(n),
            "that of the grains, " + std::to_string(n_grains));
  for (const Vec3 &position : places.position)
    require_finite(position, "place of a grain of the loose packing");
  for (const Quaternion &orientation : places.orientation)
    require(std::abs(orientation.norm() - 1.) < 1e-6, "length of an orientation of the loose packing",
            orientation.norm(), "1");
}

Tightening tighten(const std::span<const Superquadric> grains, const PackingSpace &space, const LoosePacking &start,
                   const TighteningParameters &parameters, const std::uint64_t seed)
{
  parameters.validate();
  start.validate(grains.size());
  for (const Superquadric &grain : grains)
    grain.validate();
  if (grains.empty())
    return {};
  return Tightener(grains, space, start, parameters, seed).run();
}

} // namespace bergamo::dem
