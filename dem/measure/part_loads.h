#pragma once

#include "dem/force/touching_contact.h"
#include "dem/state/particles.h"
#include "dem/state/surface.h"

#include <cstdint>
#include <span>
#include <vector>

namespace bergamo::dem
{

/// Parts of a surface, as the tip and the shaft of a pile.
struct SurfaceParts
{
  std::int32_t surface = 0;          ///< its number in the simulation
  std::int32_t n_parts = 1;          ///< they are counted from 0
  std::vector<std::int32_t> of_face; ///< part of each triangle
};

/// What grains exert on a part of a surface at this step, with the contacts' weights.
struct PartLoad
{
  Vec3 force = Vec3::Zero();  ///< [N]
  Vec3 moment = Vec3::Zero(); ///< about the origin [N m]
  double normal = 0.;         ///< sum of the normal forces' sizes [N]
  double shear = 0.;          ///< of the tangential forces' sizes: at most Coulomb's coefficient times normal [N]
};

/// A contact on an edge or a vertex where parts meet belongs to the first of them: the tip first, and its rim is the
/// tip's. So the loads add up to the surface's.
/// @param contacts with walls and surfaces, as Contacts::touching_walls() lists them @return one a part
std::vector<PartLoad> part_loads(const Particles &particles, std::span<const Surface> surfaces,
                                 std::span<const TouchingContact> contacts, const SurfaceParts &parts);

} // namespace bergamo::dem
