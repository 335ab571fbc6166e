#pragma once

#include "dem/force/contacts.h"

#include <span>
#include <string>
#include <utility>
#include <vector>

namespace bergamo::dem
{

/// Bins of three distributions of an assembly, each with its name: normal forces over their mean (density), mobilised
/// friction (density), and directions of the contacts over the angle to z (density over that of an isotropic assembly,
/// and mean normal force of the bin over the mean of all). The names do not depend on the contacts.
/// @param friction Coulomb's coefficient
std::vector<std::pair<std::string, double>> contact_distributions(std::span<const TouchingContact> contacts,
                                                                  double friction);

} // namespace bergamo::dem
