#pragma once

#include "dem/force/contacts.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace bergamo::driver
{

/// Columns of distributions.csv: time_s, stage, and the bins of three distributions: normal forces over their mean
/// (density), mobilised friction (density), and directions of the contacts over the angle to z (density over that of an
/// isotropic assembly, and mean normal force of the bin over the mean of all).
std::vector<std::string> distribution_columns();

/// One row. @param time [s]; @param friction Coulomb's coefficient
std::vector<double> distribution_row(double time, std::int64_t stage, std::span<const dem::TouchingContact> contacts,
                                     double friction);

} // namespace bergamo::driver
