#pragma once

#include "dem/force/pair_contacts.h"
#include "dem/force/wall_contacts.h"

#include <span>
#include <vector>

namespace bergamo::dem
{

/// The second body of a contact with a wall.
inline constexpr std::int32_t no_grain = -1;

/// Touching contacts with walls in the order of the candidates: body 1 is the grain, body 2 is no_grain. The branch
/// ends at the contact point, where the boundary is, so that stresses of a packing between walls are complete.
std::vector<TouchingContact> touching_walls(const WallContacts &walls);

/// Place of a contact with a grain or a wall [m]; in a periodic cell beside body 1, maybe outside of the cell.
Vec3 contact_point(const TouchingContact &contact, const Particles &particles);

/// Largest overlap of any contact over the smaller bounding radius of its grains; 0 without contacts.
double largest_relative_overlap(std::span<const TouchingContact> contacts, const Particles &particles);

/// The same over all contacts of an assembly, those with walls too.
double largest_relative_overlap(const PairContacts &pairs, const WallContacts &walls, const Particles &particles);

/// Force on body 1 with the contact's weight [N].
inline Vec3 force_on_body1(const TouchingContact &contact)
{
  return contact.state.weight * contact.state.forces.on_body1(contact.state.normal);
}

} // namespace bergamo::dem
