#pragma once

#include "dem/force/touching_contact.h"
#include "dem/state/particles.h"

#include <filesystem>
#include <span>

namespace bergamo::dem
{

/// Writes touching contacts as lines, a VTU file for ParaView: force chains. A line runs from the centre of the first
/// grain along the branch, to the centre of the second one or to the place on a wall. Cell data: ids of both grains, -1
/// for a wall; normal force with the contact's weight [N], tangential force on the first one [N], normal from the first
/// one outwards, place of the contact [m], overlap [m]. So the force on the first one is tangential - normal force
/// times normal, and acts at the place.
///
/// Throws RunError where the file cannot be written.
/// @param contacts as Contacts::touching() and touching_walls() list them
void write_contacts_vtu(const Particles &particles, std::span<const TouchingContact> contacts,
                        const std::filesystem::path &path);

} // namespace bergamo::dem
