#include "dem/measure/part_loads.h"

#include "dem/measure/contact_list.h"

#include <algorithm>

namespace bergamo::dem
{
namespace
{

/// The first part that has a face at a feature.
std::int32_t part_of(const SurfaceTopology &topology, const FeatureOfSurface &f,
                     const std::span<const std::int32_t> of_face)
{
  if (f.feature == Feature::face)
    return of_face[f.number];
  if (f.feature == Feature::edge)
  {
    const SurfaceTopology::Edge &e = topology.edge[f.number];
    return e.right == SurfaceTopology::none ? of_face[e.left] : std::min(of_face[e.left], of_face[e.right]);
  }
  const std::span<const SurfaceTopology::Corner> corners = topology.corners_of(f.number);
  std::int32_t first = of_face[corners.front().face];
  for (const SurfaceTopology::Corner &corner : corners)
    first = std::min(first, of_face[corner.face]);
  return first;
}

} // namespace

std::vector<PartLoad> part_loads(const Particles &particles, const std::span<const Surface> surfaces,
                                 const std::span<const TouchingContact> contacts, const SurfaceParts &parts)
{
  std::vector<PartLoad> loads(parts.n_parts);
  for (const TouchingContact &contact : contacts)
  {
    if (contact.feature < 0)
      continue;
    const FeatureOfSurface f = feature_of(surfaces, contact.feature);
    if (f.surface != parts.surface)
      continue;
    PartLoad &load = loads[part_of(surfaces[f.surface].topology, f, parts.of_face)];
    const Vec3 force = -force_on_body1(contact);
    load.force += force;
    load.moment += contact_point(contact, particles).cross(force);
    load.normal += contact.state.weight * contact.state.forces.normal;
    load.shear += contact.state.weight * contact.state.forces.tangential.norm();
  }
  return loads;
}

} // namespace bergamo::dem
