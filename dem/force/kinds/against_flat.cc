#include "dem/force/kinds/against_flat.h"

#include "dem/force/searched_contact.h"
#include "dem/geometry/turn_wear.h"

namespace bergamo::dem
{

BodyPose pose_of(const Particles &p, const std::int32_t part, const std::int32_t particle)
{
  if (p.has_clumps())
    return make_pose(p.parts.shape[part], p.part_position(part), p.part_orientation(part));
  return make_pose(p.parts.shape[part], p.position[particle], p.orientation[particle]);
}

void take_flat_place(ContactSearch &search, const ContactScene &scene, const FlatPlace &place,
                     const WallMotion<double> &motion, ContactState<double> &s, ContactLosses &losses)
{
  const Particles &p = scene.particles;
  const auto &[normal, overlap, weight] = place;
  const BodyPose pose = pose_of(p, search.first_part, search.first);
  const TangentFrame frame = tangent_frame(normal);
  const PlacedSupport<double> g = support(pose, normal, frame);
  const ContactState<double> before = s;
  const CurvatureBounds<double> bounds = curvature_bounds(pose.shape, scene.parameters.curvature_bound);
  Vec3 point = g.arm - 0.5 * overlap * normal;
  if (p.has_clumps()) // the part's centre minus the particle's
    point += Vec3(p.orientation[search.first] * p.parts.place[search.first_part]);
  place_contact(s, normal, point, overlap, relative_curvature(frame, principal_radii(pose, normal, g.radii), bounds),
                scene.law.elastic);
  s.radii1 = seen_from(s.axis, frame, g.radii);
  TangentFrame seen;
  seen << s.axis, s.second_axis();
  give_budget<double>(
      s, scene.parameters,
      {RadiiChange<double>(pose, normal, g.arm), seen, s.radii1, error_of_following(scene.parameters, overlap)}, {});
  s.radii1 = s.radii1 - 0.5 * overlap;
  s.weight = weight;
  s.reduced_mass = p.mass[search.first]; // what it touches is infinitely heavy
  take_search(s, before, motion, scene, losses);
  const Vec3 force = s.force();
  search.resultant = {force, s.point.cross(force), Vec3::Zero()};
}

} // namespace bergamo::dem
