#pragma once

#include "dem/force/touching_contact.h"
#include "dem/state/particles.h"

#include <span>
#include <vector>

namespace bergamo::dem
{

// Forces are those of the grains, without the contacts' weights.

/// Mean normal force of the contacts [N]; 0 without contacts.
double mean_normal_force(std::span<const TouchingContact> contacts);

/// Normal force of every contact over their mean, for histogram(); zeros where there is no force.
std::vector<double> relative_normal_forces(std::span<const TouchingContact> contacts);

/// Share of Coulomb's limit mu f_N that the tangential force of every contact takes, in [0, 1]; 0 where the limit is.
std::vector<double> mobilised_friction(std::span<const TouchingContact> contacts, double friction);

/// Share of the contacts at Coulomb's limit, but for rounding; none without friction, where the limit says nothing.
double sliding_fraction(std::span<const TouchingContact> contacts, double friction);

/// Contacts by the angle in [0, pi/2] between the line of their normal and an axis, in bins of equal angle.
struct DirectionDistribution
{
  std::vector<double> density;      ///< share of the contacts over the bin's share of the unit sphere: 1 if isotropic
  std::vector<double> normal_force; ///< mean of the bin over the mean of all; 0 in an empty bin
};

/// @param axis of any length but zero, global; @throws ConfigError for an axis or a number of bins of zero
DirectionDistribution direction_distribution(std::span<const TouchingContact> contacts, const Vec3 &axis, int n_bins);

} // namespace bergamo::dem
