#include "drivers/penetration/intrusion.h"

#include "coupling/model/energy_balance.h"

#include <utility>

namespace bergamo::driver
{

Intrusion::Intrusion(const PenetrationParameters &p, std::unique_ptr<dem::Simulation> sand, const double height)
    : parameters(p)
{
  grains = &model.add(std::make_unique<coupling::GrainsMover>(std::move(sand), "sand"));
  intruder = place_intruder(model, *grains, p.make_intruder(height), "intruder");
  const dem::Particles &particles = grains->simulation().particles;
  start_places.resize(particles.size());
  for (std::size_t i = 0; i < particles.size(); ++i)
    start_places[particles.id[i]] = particles.position[i];
}

void Intrusion::compute(const double time)
{
  const double step = parameters.simulation.time_step;
  intruder.mover->body().guide().velocity[2] = -parameters.speed_at(time + 0.5 * step);
  model.compute_forces();
  model.kick(step);
}

void Intrusion::move()
{
  model.drift(parameters.simulation.time_step);
}

double Intrusion::energy_balance() const
{
  return coupling::energy_balance(model);
}

void Intrusion::visit(StateVisitor &visit)
{
  for (const auto &[name, values] : intruder.mover->body().state())
    visit("intruder/" + name, values);
  visit("start_places", start_places);
}

} // namespace bergamo::driver
