#pragma once

#include "drivers/beam_impact/trajectory.h"
#include "drivers/common/summary.h"

#include <string>

namespace bergamo::driver
{

/// Times and forces of the impacts of a trajectory, and the velocity with which the sphere leaves the last of them.
/// @param prefix of the names; @param time_step [s]
void add_impacts(Summary &summary, const std::string &prefix, const Trajectory &way, double time_step);

/// Largest differences of a trajectory from a closed form, over the largest of that, and those of the impulses.
void add_deviations(Summary &summary, const std::string &prefix, const Trajectory &way, const Trajectory &exact);

} // namespace bergamo::driver
