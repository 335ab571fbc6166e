#pragma once

#include "drivers/pile_installation/start.h"
#include "fe_dealii/explicit_body.h"

#include <memory>

namespace bergamo::driver
{

/// The elements of a plan, under their weight and with the stresses of sand at rest: upright those of the weight above,
/// sideways the same share of it as in the settled sand.
std::unique_ptr<fe::ExplicitBody> make_ground(const InstallationParameters &parameters, const InstallationStart &start,
                                              const GroundPlan &plan);

/// Throws ConfigError. @param limit stable step of the elements [s]
void require_below(double limit, double time_step);

/// Throws ConfigError where the time step is above the stable one of the elements, on the lowest ground that the sand
/// may settle to: told before the grains are packed.
void require_stable_ground(const InstallationParameters &parameters);

} // namespace bergamo::driver
