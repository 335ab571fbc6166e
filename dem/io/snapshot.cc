#include "dem/io/snapshot.h"

#include "dem/core/state.h"

namespace bergamo::dem
{

void write_simulation(ArchiveWriter &archive, const Simulation &simulation)
{
  StateWriter writer(archive, "dem");
  Simulation::visit_state(simulation, writer);
}

std::unique_ptr<Simulation> read_simulation(const ArchiveReader &archive, const SimulationParameters &parameters)
{
  StateReader reader(archive, "dem");
  return std::make_unique<Simulation>(parameters, reader);
}

} // namespace bergamo::dem
