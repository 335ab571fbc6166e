#include "drivers/penetration/intrusion.h"

#include "coupling/adapter/surface_contact.h"
#include "coupling/model/energy_balance.h"

#include <utility>

namespace bergamo::driver
{

Intrusion::Intrusion(const PenetrationParameters &p, std::unique_ptr<dem::Simulation> sand, const double height)
    : parameters(p)
{
  Intruder made = p.make_intruder(height);
  tip_and_shaft = std::move(made.parts);
  grains = &model.add(std::make_unique<coupling::GrainsMover>(std::move(sand), "sand"));
  intruder = &model.add(std::make_unique<coupling::RigidMover>(made.body, "intruder"));
  dem::Simulation &simulation = grains->simulation();
  if (simulation.surfaces.empty()) // else it was stored with the grains
  {
    dem::Surface surface = coupling::surface_of(intruder->body());
    surface.material = intruder_material;
    simulation.add_surface(std::move(surface));
  }
  model.add(std::make_unique<coupling::SurfaceContact>(*grains, *intruder, tip_and_shaft.surface));
  const dem::Particles &particles = simulation.particles;
  start_places.resize(particles.size());
  for (std::size_t i = 0; i < particles.size(); ++i)
    start_places[particles.id[i]] = particles.position[i];
}

void Intrusion::compute(const double time)
{
  const double step = parameters.simulation.time_step;
  intruder->body().guide().velocity[2] = -parameters.speed_at(time + 0.5 * step);
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
  for (const auto &[name, values] : intruder->body().state())
    visit("intruder/" + name, values);
  visit("start_places", start_places);
}

} // namespace bergamo::driver
