#pragma once

#include "dem/simulation/simulation.h"
#include "drivers/common/run/state_visitor.h"
#include "fe_dealii/moving_body.h"
#include "fe_dealii/step_control.h"

#include <memory>

namespace bergamo::driver
{

/// Writes the grains, to the last bit, or makes those that were written.
/// @param grains to write; not looked at in reading @param parameters of the grains that are read
/// @return what was read, nothing in writing
std::unique_ptr<dem::Simulation> visit_grains(StateVisitor &visit, const dem::Simulation *grains,
                                              const dem::SimulationParameters &parameters);

/// All that changes of a body from step to step. @param body set up as the one that was written
void visit_body(StateVisitor &visit, fe::MovingBody &body);

/// What the time step of a body follows.
void visit_steps(StateVisitor &visit, fe::StepControl &steps);

} // namespace bergamo::driver
