#include "dem/force/surface_loads.h"

namespace bergamo::dem
{
namespace
{

/// Calls visit(feature, point, force on the surface) for each contact with a surface, in the order of the slots.
template <class Visit>
void for_each_contact(const Particles &particles, const Contacts &contacts, const std::span<const Surface> surfaces,
                      const Visit &visit)
{
  for (const ContactSet<GrainSurface> &set : contacts.grain_surface)
  {
    const auto &store = set.touching();
    for (std::size_t block = 0; block < store.n_blocks(); ++block)
    {
      const Vector3<Pack> force = store.blocks[block].force();
      for (int lane = 0; lane < pack_width; ++lane)
      {
        const std::size_t slot = block * pack_width + lane;
        if (store.pair[slot] == store.free_slot)
          continue;
        const Vec3 point = particles.position[store.first[slot]] + math::lane<Pack>(store.blocks[block].point, lane);
        visit(feature_of(surfaces, store.second[slot]), point, Vec3(-math::lane<Pack>(force, lane)));
      }
    }
  }
}

} // namespace

std::vector<SurfaceLoad> surface_loads(const Particles &particles, const Contacts &contacts,
                                       const std::span<const Surface> surfaces)
{
  std::vector<SurfaceLoad> loads(surfaces.size());
  for_each_contact(particles, contacts, surfaces,
                   [&](const FeatureOfSurface &f, const Vec3 &point, const Vec3 &force)
                   {
                     loads[f.surface].force += force;
                     loads[f.surface].moment += point.cross(force);
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
  for_each_contact(particles, contacts, surfaces,
                   [&](const FeatureOfSurface &f, const Vec3 &point, const Vec3 &force)
                   {
                     if (is_wanted[f.surface])
                       surfaces[f.surface].add_force(f, point, force, forces[f.surface]);
                   });
  return forces;
}

} // namespace bergamo::dem
