#include "dem/force/kinds/grain_plane.h"

#include "dem/force/follow.h"
#include "dem/force/kinds/against_flat.h"
#include "dem/force/searched_contact.h"

namespace bergamo::dem
{
namespace
{

WallMotion<double> motion_of(const ContactSearch &search, const ContactScene &scene)
{
  const Particles &p = scene.particles;
  return {scene.walls[search.second].drift_velocity - p.drift_velocity[search.first], p.angular_velocity[search.first],
          scene.time_step};
}

/// @param[in,out] s with the state of last step, or ContactState::begin(); stays so where the part is apart
void locate(ContactSearch &search, const ContactScene &scene, ContactState<double> &s, ContactLosses &losses)
{
  const PlaneWall &wall = scene.walls[search.second];
  const BodyPose pose = pose_of(scene.particles, search.first_part, search.first);
  const double height = support(pose, Vec3(-wall.normal)).height;
  const double overlap = height - wall.normal.dot(pose.position - wall.point);
  search.gap = -overlap;
  search.is_touching = overlap > 0.;
  if (search.is_touching)
    take_flat_place(search, scene, {-wall.normal, overlap, scene.particles.weight[search.first]},
                    motion_of(search, scene), s, losses);
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
