#include "dem/packing/grain_move.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace bergamo::dem
{
namespace
{

constexpr double least_share = 0.25, largest_share = 0.75; // of what is possible

std::span<TangentPlane>::iterator nearest(const std::span<TangentPlane> planes)
{
  return std::min_element(planes.begin(), planes.end(), [](const auto &a, const auto &b) { return a.room < b.room; });
}

/// Moves away from the nearest plane, several times: the next plane may be another one.
Vec3 translate(const std::span<TangentPlane> planes, const double longest, RandomStream &random)
{
  constexpr int n_times = 4;
  Vec3 way = Vec3::Zero();
  for (int k = 0; k < n_times; ++k)
  {
    const Vec3 direction = -nearest(planes)->normal;
    double free = longest / n_times / largest_share;
    for (const TangentPlane &plane : planes)
    {
      const double approach = plane.normal.dot(direction);
      if (approach > 0.)
        free = std::min(free, plane.room / approach);
    }
    const Vec3 step = random.uniform(least_share, largest_share) * free * direction;
    way += step;
    for (TangentPlane &plane : planes)
      plane.room -= plane.normal.dot(step);
  }
  return way;
}

/// Turns the point nearest to a plane away from it, by less where another plane becomes as near.
Quaternion rotate(const BodyPose &grain, const std::span<TangentPlane> planes, const double largest,
                  RandomStream &random)
{
  constexpr int n_times = 4;
  const TangentPlane &plane = *nearest(planes);
  const double room = plane.room;
  const Vec3 axis = plane.normal.cross(support(grain, plane.normal).arm);
  if (axis.norm() < 1e-6 * plane.height)
    return Quaternion::Identity();
  double angle = random.uniform(least_share, largest_share) * largest;
  std::vector<double> heights(planes.size());
  for (int k = 0; k < n_times; ++k, angle *= 0.4)
  {
    const Quaternion turn(Eigen::AngleAxisd(angle, axis.normalized()));
    const BodyPose turned{grain.shape, turn.toRotationMatrix() * grain.rotation, grain.position};
    bool has_more_room = true;
    for (std::size_t j = 0; j < planes.size() && has_more_room; ++j)
    {
      heights[j] = support(turned, planes[j].normal).height;
      has_more_room = planes[j].room + planes[j].height - heights[j] > room;
    }
    if (!has_more_room)
      continue;
    for (std::size_t j = 0; j < planes.size(); ++j)
    {
      planes[j].room += planes[j].height - heights[j];
      planes[j].height = heights[j];
    }
    return turn;
  }
  return Quaternion::Identity();
}

} // namespace

GrainMove choose_move(const BodyPose &grain, const std::span<TangentPlane> planes, const MoveLimits &limits,
                      RandomStream &random)
{
  GrainMove move;
  if (planes.empty())
  {
    move.growth = limits.growth;
    return move;
  }
  if (random.uniform() < limits.translation_probability)
    move.translation = translate(planes, limits.translation, random);
  else
    move.rotation = rotate(grain, planes, limits.angle, random);
  move.growth = limits.growth;
  for (const TangentPlane &plane : planes)
    move.growth = std::min(move.growth, largest_share * plane.room / plane.height);
  return move;
}

} // namespace bergamo::dem
