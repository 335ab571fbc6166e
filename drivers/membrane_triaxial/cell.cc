#include "drivers/membrane_triaxial/cell.h"

#include "coupling/model/energy_balance.h"
#include "drivers/common/run/visit_models.h"

#include <algorithm>
#include <utility>

namespace bergamo::driver
{

TriaxialCell::TriaxialCell(const MembraneTriaxialParameters &p, std::unique_ptr<dem::Simulation> sample,
                           const Prism &mould)
    : TriaxialCell(p, std::move(sample), make_membrane(p.membrane, mould), mould)
{
}

TriaxialCell::TriaxialCell(const MembraneTriaxialParameters &p, std::unique_ptr<dem::Simulation> sample,
                           std::unique_ptr<fe::MembraneBody> membrane, const Prism &mould)
    : parameters(p), shape(p.membrane, *membrane, mould), before(sample->times)
{
  const fe::FaceTriangles faces = faces_of(*membrane);
  fe::Surface all = fe::membrane_surface(membrane->dof_handler());
  for (const unsigned int rim : {lower_rim, upper_rim})
    for (const unsigned int component : {0, 1})
      membrane->prescribe_velocity(rim, component);
  lower = membrane->prescribe_velocity(lower_rim, 2);
  upper = membrane->prescribe_velocity(upper_rim, 2);

  grains = &model.add(std::make_unique<coupling::GrainsMover>(std::move(sample), "sample"));
  rubber = &model.add(std::make_unique<ClockedBody>(std::move(membrane), "membrane"));
  model.add(std::make_unique<coupling::SurfaceContact>(*grains, *rubber, faces, side));
  around = &model.add(std::make_unique<LateralPressure>(*rubber, std::move(all)));
}

void TriaxialCell::load(const double pressure)
{
  Stopwatch watch;
  compute_forces(pressure);
  const double push = pressure * section() - axial_force();
  const double fastest = dem::speed_of_pressure(pressure, parameters.simulation.grain().density);
  const dem::Piston plate = plate_piston(sample(), push, fastest);
  kick(plate.speed_after(sample().walls[lower_plate].velocity[2], parameters.simulation.time_step));
  watch.lap(seconds);
}

void TriaxialCell::compress(const double pressure, const double speed)
{
  Stopwatch watch;
  compute_forces(pressure);
  kick(0.5 * speed);
  watch.lap(seconds);
}

void TriaxialCell::compute_forces(const double pressure)
{
  around->set(pressure);
  model.compute_forces();
}

void TriaxialCell::kick(const double plate_speed)
{
  set_plates(grains->simulation(), plate_speed);
  rubber->body().set_velocity(lower, plate_speed);
  rubber->body().set_velocity(upper, -plate_speed);
  model.kick(parameters.simulation.time_step);
}

void TriaxialCell::move()
{
  Stopwatch watch;
  model.drift(parameters.simulation.time_step);
  watch.lap(seconds);
}

double TriaxialCell::height() const
{
  return sample().walls[upper_plate].point[2] - sample().walls[lower_plate].point[2];
}

double TriaxialCell::membrane_force() const
{
  return 0.5 * (membrane().reaction(lower) - membrane().reaction(upper));
}

double TriaxialCell::energy_balance() const
{
  return coupling::energy_balance(model) - around->work();
}

double TriaxialCell::work() const
{
  return grains->energy().work + rubber->energy().work + around->work();
}

CellShares TriaxialCell::shares() const
{
  const PhaseTimes &now = sample().times;
  const double of_grains = (now.total() - before.total()) / seconds, of_rubber = rubber->seconds() / seconds;
  return {of_grains, (now.searches - before.searches) / seconds, of_rubber, 1. - of_grains - of_rubber};
}

void TriaxialCell::visit_membrane(StateVisitor &visit)
{
  visit_body(visit, rubber->body());
  around->visit(visit);
}

} // namespace bergamo::driver
