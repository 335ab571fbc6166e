#include "drivers/common/run/visit_models.h"

#include "dem/io/snapshot.h"

namespace bergamo::driver
{

std::unique_ptr<dem::Simulation> visit_grains(StateVisitor &visit, const dem::Simulation *grains,
                                              const dem::SimulationParameters &parameters)
{
  if (visit.is_reading())
    return dem::read_simulation(*visit.reader(), parameters);
  dem::write_simulation(*visit.writer(), *grains);
  return nullptr;
}

void visit_body(StateVisitor &visit, fe::MovingBody &body)
{
  for (const auto &[name, values] : body.state())
    visit("continuum/" + name, values);
}

void visit_steps(StateVisitor &visit, fe::StepControl &steps)
{
  for (const auto &[name, values] : steps.state())
    visit("continuum/steps/" + name, values);
}

} // namespace bergamo::driver
