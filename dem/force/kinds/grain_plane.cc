#include "dem/force/kinds/grain_plane.h"

#include "dem/force/follow.h"
#include "dem/force/searched_contact.h"
#include "dem/geometry/contact_geometry.h"
#include "dem/geometry/turn_wear.h"

namespace bergamo::dem
{
namespace
{

/// Rigid motion of a grain against a wall since the last step, as PairMotion.
template <class Real>
struct WallMotion
{
  Vector3<Real> velocity; ///< of the wall minus the grain's [m/s]
  Vector3<Real> spin;     ///< of the grain [1/s]
  double time_step;

  /// @param point contact point minus the grain's centre [m]
  Vector3<Real> displacement(const Vector3<Real> &point) const
  {
    return (velocity - spin.cross(point)) * Real(time_step);
  }

  /// As PairMotion::turn(): the plane's radii are infinite, so the normal is that of the plane.
  ContactTurn<Real> turn(const ContactState<Real> &s, const TangentFrameOf<Real> &frame) const
  {
    const Real half(0.5);
    const Vector3<Real> rotation = spin * Real(time_step), of_arm = rotation.cross(s.point);
    const Vector3<Real> at_old_point = velocity * Real(time_step) - of_arm;
    const Vector2<Real> about = in_frame(frame, rotation), roll(about[1], -about[0]); // rotation x normal
    ContactTurn<Real> turn;
    turn.tilt = {Real(0.), Real(0.)};
    turn.spin = half * s.normal.dot(rotation); // the mean of both bodies
    turn.shift = of_arm - from_frame<Real>(frame, s.radii1 * roll) + s.normal * (half * s.normal.dot(at_old_point));
    turn.wear = math::sqrt(squared_wear(s.wear1, roll)) + s.twist_wear * math::abs(turn.spin);
    const Vector3<Real> displacement = at_old_point - rotation.cross(turn.shift) * half;
    Vector3<Real> seen;
    seen << in_frame(frame, displacement), s.normal.dot(displacement);
    turn.motion = seen_halfway<Real>(turn.tilt, turn.spin, seen);
    return turn;
  }
};

WallMotion<double> motion_of(const ContactSearch &search, const ContactScene &scene)
{
  const Particles &p = scene.particles;
  return {scene.walls[search.second].drift_velocity - p.drift_velocity[search.first], p.angular_velocity[search.first],
          scene.time_step};
}

/// Centre of a part minus its particle's [m].
Vec3 arm_of(const Particles &p, const std::int32_t part, const std::int32_t particle)
{
  return p.orientation[particle] * p.parts.place[part];
}

/// @param[in,out] s with the state of last step, or ContactState::begin(); stays so where the part is apart
void locate(ContactSearch &search, const ContactScene &scene, ContactState<double> &s, ContactLosses &losses)
{
  const Particles &p = scene.particles;
  const PlaneWall &wall = scene.walls[search.second];
  const Vec3 normal = -wall.normal;
  BodyPose pose = make_pose(p.parts.shape[search.first_part], p.position[search.first], p.orientation[search.first]);
  if (p.has_clumps())
    pose = make_pose(p.parts.shape[search.first_part], p.part_position(search.first_part),
                     p.part_orientation(search.first_part));
  const TangentFrame frame = tangent_frame(normal);
  const PlacedSupport<double> g = support(pose, normal, frame);
  const double overlap = g.height - wall.normal.dot(pose.position - wall.point);
  search.gap = -overlap;
  search.is_touching = overlap > 0.;
  if (!search.is_touching)
    return;

  const ContactState<double> before = s;
  const CurvatureBounds<double> bounds = curvature_bounds(pose.shape, scene.parameters.curvature_bound);
  Vec3 point = g.arm - 0.5 * overlap * normal;
  if (p.has_clumps())
    point += arm_of(p, search.first_part, search.first);
  place_contact(s, normal, point, overlap, relative_curvature(frame, principal_radii(pose, normal, g.radii), bounds),
                scene.law.elastic);
  s.radii1 = seen_from(s.axis, frame, g.radii);
  TangentFrame seen;
  seen << s.axis, s.second_axis();
  give_budget<double>(
      s, scene.parameters,
      {RadiiChange<double>(pose, normal, g.arm), seen, s.radii1, scene.parameters.overlap_tolerance * overlap}, {});
  s.radii1 = s.radii1 - 0.5 * overlap;
  s.weight = p.weight[search.first];
  s.reduced_mass = p.mass[search.first]; // the wall is infinitely heavy
  take_search(s, before, motion_of(search, scene), scene, losses);
  const Vec3 force = s.force();
  search.resultant = {force, s.point.cross(force), Vec3::Zero()};
}

} // namespace

math::Mask<Pack> GrainPlane::follow_block(Store &store, LoadSums &loads, const std::size_t block,
                                          const ContactScene &scene, Losses<Pack> &losses)
{
  const Particles &p = scene.particles;
  const auto grain = [&](const int lane) { return store.first[block * pack_width + lane]; };
  const auto plane = [&](const int lane) { return store.second[block * pack_width + lane]; };
  const WallMotion<Pack> motion{
      math::gather_vectors<Pack>([&](const int lane) -> const Vec3 &
                                 { return scene.walls[plane(lane)].drift_velocity; }) -
          math::gather_vectors<Pack>([&](const int lane) -> const Vec3 & { return p.drift_velocity[grain(lane)]; }),
      math::gather_vectors<Pack>([&](const int lane) -> const Vec3 & { return p.angular_velocity[grain(lane)]; }),
      scene.time_step};
  ContactState<Pack> &state = store.blocks[block];
  const Followed<Pack> followed = follow(state, motion, scene.law, losses);
  loads.add(block, followed.force, state.point.cross(followed.force), Vector3<Pack>(0., 0., 0.));
  return followed.is_due;
}

void GrainPlane::search(const std::span<ContactSearch> searches, const SearchContext<GrainPlane> &context,
                        ContactLosses &losses, std::vector<BegunContact<GrainPlane>> &begun)
{
  for (std::size_t k = 0; k < searches.size(); ++k)
  {
    ContactSearch &search = searches[k];
    State state = search.slot >= 0 ? context.store.get(search.slot) : State::begin();
    locate(search, context.scene, state, losses);
    if (!search.is_touching)
      continue;
    if (search.slot >= 0)
      context.store.set(search.slot, state);
    else
      begun.push_back({k, state});
  }
}

ContactLosses GrainPlane::end(const ContactSearch &search, const State &state, const ContactScene &scene)
{
  return end_of(state, motion_of(search, scene));
}

void GrainPlane::refresh(Store &store, const Particles &)
{
  search_all_anew(store);
}

TouchingContact GrainPlane::view(const ContactSearch &place, const State &state, const Particles &)
{
  return {place.first, no_grain, view_of(state), state.point, own_image, place.second};
}

} // namespace bergamo::dem
