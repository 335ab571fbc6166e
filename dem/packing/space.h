#pragma once

#include "dem/core/types.h"
#include "dem/geometry/contact_geometry.h"

#include <array>
#include <optional>
#include <span>
#include <vector>

namespace bergamo::dem
{

/// Axis-aligned box [m].
struct Box
{
  Vec3 low = Vec3::Zero(), high = Vec3::Ones();

  Vec3 edges() const { return high - low; }
  double volume() const { return edges().prod(); }
};

/// The points x with normal.x <= offset.
struct HalfSpace
{
  Vec3 normal = Vec3::UnitX(); ///< unit, away from the grains
  double offset = 0.;          ///< [m]
};

/// How far a grain reaches from the axis of a cylinder along z.
struct RadialReach
{
  Vec3 direction = Vec3::UnitX(); ///< horizontal unit vector in which the grain reaches furthest
  double reach = 0.;              ///< along it [m]
  double bound = 0.;              ///< no point of the grain is further from the axis [m]
};

/// @param centre a point of the axis [m]. The bound is proven and at most 1e-9 of the reach above it: a point that is
/// furthest from the axis in an angle [a, b] lies below the two tangents of the grain's outline at a and b; the angles
/// are halved until their intersection says no more than the largest support height found.
RadialReach radial_reach(const BodyPose &grain, const Vec3 &centre);

/// Where grains may lie: a convex body between plane walls, at most one cylindrical wall besides, or a box that repeats
/// in some directions and has walls across the others.
class PackingSpace
{
public:
  /// A box between six walls. Throws ConfigError for an edge that is not positive.
  PackingSpace(const Box &box);

  /// A box that repeats in the given directions, with walls across the others. Centres lie in the box, grains may reach
  /// out of it where it repeats.
  static PackingSpace periodic(const Box &box, const std::array<bool, 3> &repeats = {true, true, true});

  /// Upright cylinder about z. @param base centre of its bottom [m]; @param radius, height [m]
  static PackingSpace cylinder(const Vec3 &base, double radius, double height);

  /// Convex polyhedron between planes; normals of any length are made unit, offsets with them. Throws ConfigError where
  /// they enclose no volume or do not close.
  static PackingSpace polyhedron(std::vector<HalfSpace> planes);

  const Box &bounds() const { return box; } ///< of the space; of a periodic one, the box itself
  double volume() const { return solid; }   ///< [m^3]
  bool is_periodic(const int direction) const { return repeats[direction]; }
  bool is_periodic() const { return repeats[0] || repeats[1] || repeats[2]; } ///< in any direction
  std::span<const HalfSpace> walls() const { return planes; }
  std::optional<RadialReach> curved_wall(const BodyPose &grain) const; ///< none without a cylindrical wall
  double curved_wall_radius() const { return radius; }                 ///< [m]

  /// Whether a grain lies inside all walls.
  bool contains(const BodyPose &grain, double bounding_radius) const;

  /// A position moved by whole edges into the periodic box; elsewhere unchanged.
  Vec3 wrap(const Vec3 &position) const;

  /// From one centre to the nearest image of another one: the shortest for boxes of two ranges and more.
  Vec3 nearest_image(const Vec3 &difference) const;

  /// Throws ConfigError naming the edge, the range and the remedy for a periodic edge of at most two ranges, across
  /// which a grain would meet two images of another one.
  void require_range(double range) const;

private:
  PackingSpace() = default;

  Box box;
  std::vector<HalfSpace> planes;
  Vec3 axis = Vec3::Zero();
  double radius = 0.; // none
  double solid = 0.;
  std::array<bool, 3> repeats{};
};

} // namespace bergamo::dem
