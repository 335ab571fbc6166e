#include "dem/packing/space.h"

#include "dem/core/error.h"
#include "dem/geometry/orientation.h"
#include "dem/packing/polyhedron.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

namespace bergamo::dem
{
namespace
{

constexpr char axis_name[] = {'x', 'y', 'z'};

void check_edges(const Box &box)
{
  for (int d = 0; d < 3; ++d)
    require(box.edges()[d] > 0. && std::isfinite(box.edges()[d]),
            std::string("edge of the packing's box along ") + axis_name[d], box.edges()[d], "positive [m]");
}

std::vector<HalfSpace> planes_of(const Box &box)
{
  std::vector<HalfSpace> planes;
  for (int d = 0; d < 3; ++d)
  {
    planes.push_back({-Vec3::Unit(d), -box.low[d]});
    planes.push_back({Vec3::Unit(d), box.high[d]});
  }
  return planes;
}

/// Height of the grain's outline above the axis in a horizontal direction.
struct Tangent
{
  double angle, height;

  Tangent(const BodyPose &grain, const Vec3 &centre, const double angle) : angle(angle)
  {
    const Vec3 n = direction();
    height = n.dot(grain.position - centre) + support(grain, n).height;
  }
  Vec3 direction() const { return {std::cos(angle), std::sin(angle), 0.}; }
};

/// No point between the angles of two tangents is further from the axis.
double bound_between(const Tangent &a, const Tangent &b)
{
  if (a.height <= 0. || b.height <= 0.)
    return 0.; // a point there would be above the lower one
  // The tangents meet at height_a along a and along + across a.
  const double width = b.angle - a.angle;
  const double across = (b.height - a.height * std::cos(width)) / std::sin(width);
  const bool is_between = across >= 0. && across <= a.height * std::tan(width);
  return is_between ? std::hypot(a.height, across) : std::max(a.height, b.height);
}

void raise_reach(const BodyPose &grain, const Vec3 &centre, const Tangent &a, const Tangent &b, RadialReach &found)
{
  constexpr double resolution = 1e-9, least_width = 1e-7; // of the reach, and [rad]
  const double bound = bound_between(a, b);
  if (!(bound > found.reach * (1. + resolution)) || b.angle - a.angle < least_width)
  {
    found.bound = std::max(found.bound, bound);
    return;
  }
  const Tangent middle(grain, centre, 0.5 * (a.angle + b.angle));
  if (middle.height > found.reach)
  {
    found.reach = middle.height;
    found.direction = middle.direction();
  }
  raise_reach(grain, centre, a, middle, found);
  raise_reach(grain, centre, middle, b, found);
}

} // namespace

RadialReach radial_reach(const BodyPose &grain, const Vec3 &centre)
{
  constexpr int n = 8;
  const Vec3 arm = grain.position - centre;
  const double start = std::atan2(arm[1], arm[0]);
  std::vector<Tangent> tangents;
  for (int k = 0; k <= n; ++k)
    tangents.emplace_back(grain, centre, start + 2. * std::numbers::pi * k / n);
  RadialReach found;
  for (const Tangent &t : tangents)
    if (t.height > found.reach)
    {
      found.reach = t.height;
      found.direction = t.direction();
    }
  for (int k = 0; k < n; ++k)
    raise_reach(grain, centre, tangents[k], tangents[k + 1], found);
  found.bound = std::max(found.bound, found.reach);
  return found;
}

PackingSpace::PackingSpace(const Box &box) : box(box), planes(planes_of(box)), solid(box.volume())
{
  check_edges(box);
}

PackingSpace PackingSpace::periodic(const Box &box, const std::array<bool, 3> &repeats)
{
  PackingSpace space(box);
  std::erase_if(space.planes,
                [&](const HalfSpace &plane)
                {
                  int d = 0;
                  plane.normal.cwiseAbs().maxCoeff(&d);
                  return repeats[d];
                });
  space.repeats = repeats;
  return space;
}

PackingSpace PackingSpace::cylinder(const Vec3 &base, const double radius, const double height)
{
  require_finite(base, "base of the packing's cylinder");
  require(radius > 0. && std::isfinite(radius), "radius of the packing's cylinder", radius, "positive [m]");
  require(height > 0. && std::isfinite(height), "height of the packing's cylinder", height, "positive [m]");
  PackingSpace space;
  space.box = {base - Vec3(radius, radius, 0.), base + Vec3(radius, radius, height)};
  space.planes = {{-Vec3::UnitZ(), -base[2]}, {Vec3::UnitZ(), base[2] + height}};
  space.axis = base;
  space.radius = radius;
  space.solid = std::numbers::pi * radius * radius * height;
  return space;
}

PackingSpace PackingSpace::polyhedron(std::vector<HalfSpace> planes)
{
  for (HalfSpace &plane : planes)
  {
    const double length = plane.normal.norm();
    require(length > 0. && std::isfinite(length) && std::isfinite(plane.offset), "length of a wall's normal", length,
            "positive and its offset finite");
    plane.normal /= length;
    plane.offset /= length;
  }
  const Polyhedron body = enclosed_by(planes);
  PackingSpace space;
  space.box = {body.low, body.high};
  space.planes = std::move(planes);
  space.solid = body.volume;
  return space;
}

std::optional<RadialReach> PackingSpace::curved_wall(const BodyPose &grain) const
{
  if (radius == 0.)
    return {};
  return radial_reach(grain, axis);
}

bool PackingSpace::contains(const BodyPose &grain, const double bounding_radius) const
{
  for (const HalfSpace &wall : planes)
  {
    const double distance = wall.offset - wall.normal.dot(grain.position);
    if (distance < 0. || (distance < bounding_radius && distance < support(grain, wall.normal).height))
      return false;
  }
  if (radius == 0.)
    return true;
  const double from_axis = (grain.position - axis).head<2>().norm();
  return from_axis + bounding_radius <= radius || (from_axis < radius && radial_reach(grain, axis).bound <= radius);
}

Vec3 PackingSpace::wrap(const Vec3 &position) const
{
  Vec3 x = position;
  for (int d = 0; d < 3; ++d)
  {
    if (!repeats[d])
      continue;
    const double edge = box.high[d] - box.low[d];
    x[d] -= edge * std::floor((x[d] - box.low[d]) / edge);
    if (x[d] >= box.high[d]) // rounding, just below the low face
      x[d] = box.low[d];
  }
  return x;
}

Vec3 PackingSpace::nearest_image(const Vec3 &difference) const
{
  Vec3 x = difference;
  for (int d = 0; d < 3; ++d)
  {
    if (!repeats[d])
      continue;
    const double edge = box.high[d] - box.low[d];
    x[d] -= edge * std::round(x[d] / edge);
  }
  return x;
}

void PackingSpace::require_range(const double range) const
{
  for (int d = 0; d < 3; ++d)
    if (repeats[d] && !(box.edges()[d] > 2. * range))
    {
      std::ostringstream message;
      message << "edge of the periodic box along " << axis_name[d] << " is " << box.edges()[d]
              << " m: it must be larger than twice the range of the largest grains, " << range
              << " m; choose a larger box or smaller grains";
      throw ConfigError(message.str());
    }
}

} // namespace bergamo::dem
