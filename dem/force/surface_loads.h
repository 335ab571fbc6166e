#pragma once

#include "dem/force/contacts.h"
#include "dem/state/particles.h"
#include "dem/state/surface.h"

#include <span>
#include <vector>

namespace bergamo::dem
{

/// What grains exert on a surface at this step, with the contacts' weights.
struct SurfaceLoad
{
  Vec3 force = Vec3::Zero();  ///< [N]
  Vec3 moment = Vec3::Zero(); ///< about the origin [N m]

  Vec3 moment_about(const Vec3 &point) const { return moment - point.cross(force); }
};

/// Sums over the contacts in a fixed order. @return one a surface
std::vector<SurfaceLoad> surface_loads(const Particles &particles, const Contacts &contacts,
                                       std::span<const Surface> surfaces);

/// Forces on the nodes, by the shape functions of the features: their sums are surface_loads(). @return by surface, in
/// the order of its nodes [N]; nothing for those that are not wanted. @param is_wanted one a surface
std::vector<std::vector<Vec3>> node_forces(const Particles &particles, const Contacts &contacts,
                                           std::span<const Surface> surfaces, const std::vector<bool> &is_wanted);

} // namespace bergamo::dem
