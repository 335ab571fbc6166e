#include "dem/force/surface_loads.h"

#include <array>

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

/// The least forces on the nodes of a triangle that have no sum and a moment. In its plane the moment is that of forces
/// along the normal, which the gradients of the shape functions give; along the normal that of forces around the
/// middle.
/// @param corner its nodes [m]; @param moment [N m]; @return by node [N]
std::array<Vec3, 3> forces_of_moment(const std::array<Vec3, 3> &corner, const Vec3 &moment)
{
  const Vec3 a = corner[1] - corner[0], b = corner[2] - corner[0], normal = a.cross(b);
  const Vec3 middle = (a + b) / 3.; // from the first corner
  const std::array<Vec3, 3> edge{b - a, -b, a}, arm{-middle, a - middle, b - middle};
  const Vec3 scaled = normal / normal.squaredNorm();
  const double around = scaled.dot(moment) / (arm[0].squaredNorm() + arm[1].squaredNorm() + arm[2].squaredNorm());
  std::array<Vec3, 3> forces;
  for (int k = 0; k < 3; ++k)
    forces[k] = edge[k].dot(moment) * scaled + around * normal.cross(arm[k]);
  return forces;
}

/// Forces on the nodes of one contact: by the shape functions at the point of the feature straight below it; and what
/// the force has as a moment about that point, half an overlap off, by the least forces on a face's nodes that have it.
void add_node_forces(const Surface &surface, const FeatureOfSurface &f, const Vec3 &point, const Vec3 &force,
                     std::vector<Vec3> &forces)
{
  const NodeShares shares = node_shares(surface, f.feature, f.number, point);
  for (int k = 0; k < 3; ++k)
    forces[shares.node[k]] += shares.share[k] * force;
  const Triangle &nodes = surface.topology.triangle[surface.face_of(f)];
  const std::array<Vec3, 3> turning =
      forces_of_moment({surface.node[nodes[0]], surface.node[nodes[1]], surface.node[nodes[2]]},
                       (point - shares.of(surface.node)).cross(force));
  for (int k = 0; k < 3; ++k)
    forces[nodes[k]] += turning[k];
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
                       add_node_forces(surfaces[f.surface], f, point, force, forces[f.surface]);
                   });
  return forces;
}

} // namespace bergamo::dem
