#pragma once

#include "dem/state/material.h"
#include "drivers/common/run/step_count.h"

#include <string>
#include <vector>

namespace bergamo::driver
{

/// A warning where a time step of grains alone is so far below what their contacts need that a run only takes longer by
/// it, or none. Elements, penalties and surfaces ask for shorter steps, so it is no advice for runs with them.
/// @param radius of the smallest grains [m]
std::vector<std::string> advice_on_step(const NamedTime &step, double radius, const dem::Material &grain);

/// A warning where the penalty lets both models drift apart or is stiffer than either, or none: what it does depends on
/// penalty times diameter squared over the continuum's modulus.
/// @param diameter of the mean grain [m]; @param young_modulus of the continuum [Pa]
std::vector<std::string> advice_on_penalty(double penalty, double diameter, double young_modulus);

} // namespace bergamo::driver
