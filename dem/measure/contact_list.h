#pragma once

#include "dem/force/contacts.h"
#include "dem/state/particles.h"

#include <span>
#include <string>
#include <vector>

namespace bergamo::dem
{

/// Place of a contact with a grain or a wall [m]; in a periodic cell beside body 1, maybe outside of the cell.
Vec3 contact_point(const TouchingContact &contact, const Particles &particles);

/// Largest overlap of any contact over the smaller bounding radius of its grains; 0 without contacts.
double largest_relative_overlap(std::span<const TouchingContact> contacts, const Particles &particles);

/// The same over all contacts of an assembly, those with walls too.
double largest_relative_overlap(const Contacts &contacts, const Particles &particles);

/// Throws RunError for an overlap that says that a run has diverged: above a fifth of the smaller bounding radius.
/// @param relative_overlap see largest_relative_overlap(); @param time of the run [s]; @param remedy "a smaller step"
void check_overlap(double relative_overlap, double time, const std::string &remedy);

/// Force on body 1 with the contact's weight [N].
inline Vec3 force_on_body1(const TouchingContact &contact)
{
  return contact.state.weight * contact.state.force();
}

} // namespace bergamo::dem
