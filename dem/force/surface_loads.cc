#include "dem/force/surface_loads.h"

#include "dem/core/pack_vectors.h"

#include <algorithm>
#include <array>

namespace bergamo::dem
{
namespace
{

/// A contact with a surface.
struct Touch
{
  FeatureOfSurface feature;
  Vec3 point, force; ///< [m]; on the surface [N]
};

/// Calls visit(touches) for the contacts of each block, in the order of the slots.
template <class Visit>
void for_each_block(const Particles &particles, const Contacts &contacts, const std::span<const Surface> surfaces,
                    const Visit &visit)
{
  for (const ContactSet<GrainSurface> &set : contacts.grain_surface)
  {
    const auto &store = set.touching();
    for (std::size_t block = 0; block < store.n_blocks(); ++block)
    {
      const Vector3<Pack> force = store.blocks[block].force();
      std::array<Touch, pack_width> touches;
      std::size_t n = 0;
      for (int lane = 0; lane < pack_width; ++lane)
      {
        const std::size_t slot = block * pack_width + lane;
        if (store.pair[slot] != store.free_slot)
          touches[n++] = {feature_of(surfaces, store.second[slot]),
                          particles.position[store.first[slot]] + math::lane<Pack>(store.blocks[block].point, lane),
                          -math::lane<Pack>(force, lane)};
      }
      if (n > 0)
        visit(std::span<const Touch>(touches.data(), n));
    }
  }
}

/// Adds the forces of a block's contacts with faces to those on the nodes; lanes beyond repeat the last one.
void add_forces_on_faces(const std::span<const Touch> touches, const std::span<const Surface> surfaces,
                         std::vector<std::vector<Vec3>> &forces)
{
  const auto at = [&](const int lane) -> const Touch &
  { return touches[std::min<std::size_t>(lane, touches.size() - 1)]; };
  const auto triangle = [&](const int lane) -> const Triangle &
  { return surfaces[at(lane).feature.surface].topology.triangle[at(lane).feature.number]; };
  std::array<Vector3<Pack>, 3> node;
  for (int k = 0; k < 3; ++k)
    node[k] = math::gather_vectors<Pack>([&](const int lane) -> const Vec3 &
                                         { return surfaces[at(lane).feature.surface].node[triangle(lane)[k]]; });
  const auto point = math::gather_vectors<Pack>([&](const int lane) -> const Vec3 & { return at(lane).point; }),
             force = math::gather_vectors<Pack>([&](const int lane) -> const Vec3 & { return at(lane).force; });
  const std::array<Vector3<Pack>, 3> on_node = FacePlane<Pack>(node).forces(point - node[0], force);
  for (std::size_t lane = 0; lane < touches.size(); ++lane)
    for (int k = 0; k < 3; ++k)
      forces[touches[lane].feature.surface][triangle(lane)[k]] += math::lane<Pack>(on_node[k], lane);
}

} // namespace

std::vector<SurfaceLoad> surface_loads(const Particles &particles, const Contacts &contacts,
                                       const std::span<const Surface> surfaces)
{
  std::vector<SurfaceLoad> loads(surfaces.size());
  for_each_block(particles, contacts, surfaces,
                 [&](const std::span<const Touch> touches)
                 {
                   for (const auto &[feature, point, force] : touches)
                   {
                     loads[feature.surface].force += force;
                     loads[feature.surface].moment += point.cross(force);
                   }
                 });
  return loads;
}

std::vector<std::vector<Vec3>> node_forces(const Particles &particles, const Contacts &contacts,
                                           const std::span<const Surface> surfaces, const std::vector<bool> &is_wanted)
{
  std::vector<std::vector<Vec3>> forces(surfaces.size());
  for (std::size_t s = 0; s < surfaces.size(); ++s)
    if (is_wanted[s])
      forces[s].assign(surfaces[s].node.size(), Vec3::Zero());
  for_each_block(particles, contacts, surfaces,
                 [&](const std::span<const Touch> touches)
                 {
                   std::array<Touch, pack_width> on_faces;
                   std::size_t n_on_faces = 0;
                   for (const Touch &touch : touches)
                     if (const FeatureOfSurface &f = touch.feature; is_wanted[f.surface])
                     {
                       if (f.feature == Feature::face)
                         on_faces[n_on_faces++] = touch;
                       else
                         surfaces[f.surface].add_force(f, touch.point, touch.force, forces[f.surface]);
                     }
                   if (n_on_faces > 0)
                     add_forces_on_faces({on_faces.data(), n_on_faces}, surfaces, forces);
                 });
  return forces;
}

} // namespace bergamo::dem
