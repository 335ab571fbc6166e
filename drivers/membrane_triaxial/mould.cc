#include "drivers/membrane_triaxial/mould.h"

#include "coupling/adapter/touched_faces.h"
#include "dem/core/error.h"
#include "dem/loading/compression.h"
#include "dem/measure/solid_fraction.h"
#include "drivers/common/interrupt.h"
#include "drivers/common/packing_target.h"
#include "drivers/common/run/visit_models.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

namespace bergamo::driver
{
namespace
{

/// Sums of the impedances of the contacts [N s/m].
struct Impedances
{
  double plate = 0.; ///< of one, the mean
  double side = 0.;
};

Impedances impedances_of(const dem::Simulation &sample)
{
  Impedances sum;
  for (const dem::TouchingContact &contact : sample.contacts.touching_walls(sample.particles))
    (contact.wall < 0 ? sum.side : sum.plate) += dem::impedance_of(contact);
  return {0.5 * sum.plate, sum.side};
}

std::vector<dem::PlaneWall> plates_at(const double height)
{
  std::vector<dem::PlaneWall> plates(2);
  plates[lower_plate].point = {0., 0., -0.5 * height};
  plates[upper_plate].point = {0., 0., 0.5 * height};
  plates[upper_plate].normal = -Vec3::UnitZ();
  return plates;
}

/// Of the prism over the square of its radius.
double section_of_unit_prism(const MembraneParameters &p)
{
  return 0.5 * p.n_around * std::sin(2. * std::numbers::pi / p.n_around);
}

} // namespace

bool Mould::fill()
{
  const MouldParameters &p = parameters.mould;
  dem::PackingParameters packing;
  packing.solid_fraction = p.solid_fraction;
  packing.density = parameters.simulation.grain().density;
  packing.tightening.is_stopped = interrupted;
  const auto space = dem::PackingSpace::cylinder({0., 0., -0.5 * p.height}, 0.5 * p.diameter, p.height);
  dem::PackedGrains packed = parameters.sizes.pack(space, packing, p.seed);
  if (interrupted())
    return false;
  require_target(packed, packing.solid_fraction, "Mould/solid fraction");
  grains = std::make_unique<dem::Simulation>(parameters.shrinking(), std::move(packed.particles), plates_at(p.height));
  const Prism around{0.5 * p.diameter / std::cos(std::numbers::pi / parameters.membrane.n_around), p.height};
  const auto membrane = make_membrane(parameters.membrane, around);
  dem::Surface sides = coupling::surface_of(*membrane, faces_of(*membrane));
  sides.material = membrane_material;
  sides.velocity.assign(sides.node.size(), Vec3::Zero());
  grains->add_surface(std::move(sides));
  return true;
}

Prism Mould::prism() const
{
  return {grains->surfaces[side].node[0].head<2>().norm(),
          grains->walls[upper_plate].point[2] - grains->walls[lower_plate].point[2]};
}

/// That which does the work of the contacts where the width grows: p 2V/R = sum of f . x/R over horizontal vectors.
double Mould::pressure_on_side() const
{
  const std::vector<Vec3> force = grains->node_forces(side);
  const dem::Surface &sides = grains->surfaces[side];
  double sum = 0.;
  for (std::size_t n = 0; n < force.size(); ++n)
    sum += force[n].head<2>().dot(sides.node[n].head<2>());
  const auto [radius, height] = prism();
  return sum / (2. * section_of_unit_prism(parameters.membrane) * radius * radius * height);
}

double Mould::pressure_on_plates() const
{
  return plate_force(*grains) / (section_of_unit_prism(parameters.membrane) * std::pow(prism().radius, 2));
}

void Mould::compute()
{
  const MouldParameters &p = parameters.mould;
  grains->compute_forces();
  const auto [radius, height] = prism();
  const double section = section_of_unit_prism(parameters.membrane) * radius * radius, dt = p.time_step;
  const double most = dem::speed_of_pressure(p.pressure, parameters.simulation.grain().density);
  const Impedances impedance = impedances_of(*grains);
  const double mass = dem::piston_mass(grains->particles);
  const dem::Piston upright{mass, (p.pressure - pressure_on_plates()) * section, impedance.plate,
                            std::min(0.5 * height * p.largest_rate, most)};
  const double speed = upright.speed_after(grains->walls[lower_plate].velocity[2], dt);
  set_plates(*grains, speed);

  dem::Surface &sides = grains->surfaces[side];
  const Vec3 &first = sides.node[0];
  const double last = -sides.velocity[0].head<2>().dot(first.head<2>()) / radius;
  const dem::Piston across{2. * mass, (p.pressure - pressure_on_side()) * 2. * section * height / radius,
                           impedance.side, std::min(radius * p.largest_rate, most)};
  const double rate = across.speed_after(last, dt) / radius, rate_upright = 2. * speed / height;
  for (std::size_t n = 0; n < sides.node.size(); ++n)
    sides.velocity[n] = -Vec3(rate, rate, rate_upright).cwiseProduct(sides.node[n]);
  grains->kick();
}

void Mould::look()
{
  const MouldParameters &p = parameters.mould;
  on_plates = pressure_on_plates();
  on_side = pressure_on_side();
  const auto holds = [&](const double pressure)
  { return std::abs(pressure - p.pressure) < p.pressure_tolerance * p.pressure; };
  unbalance = dem::unbalanced_force(*grains);
  n_looks_passed = holds(on_plates) && holds(on_side) && unbalance < p.force_tolerance ? n_looks_passed + 1. : 0.;
  if (!is_finished() && time() > p.longest_time)
  {
    std::ostringstream message;
    message << "the sample did not come to rest within Mould/longest time, " << p.longest_time << " s: " << on_plates
            << " Pa on the plates, " << on_side << " Pa on the side, unbalanced force " << unbalance
            << "; allow more time, larger tolerances or a smaller largest rate";
    throw RunError(message.str());
  }
}

Table Mould::table() const
{
  const auto volume = [this]
  {
    const auto [radius, height] = prism();
    return section_of_unit_prism(parameters.membrane) * radius * radius * height;
  };
  return {{{"time_s", [this] { return time(); }},
           {"radius_m", [this] { return prism().radius; }},
           {"height_m", [this] { return prism().height; }},
           {"plate_pressure_Pa", [this] { return on_plates; }},
           {"side_pressure_Pa", [this] { return on_side; }},
           {"unbalanced_force", [this] { return unbalance; }},
           {"solid_fraction", [this, volume] { return dem::solid_fraction(grains->particles, volume()); }}}};
}

std::unique_ptr<dem::Simulation> Mould::take()
{
  grains->drift();
  set_plates(*grains, 0.);
  grains->rest();
  grains->change(parameters.testing());
  grains->reset_accounts();
  return std::move(grains);
}

void Mould::visit(StateVisitor &visit)
{
  visit("mould/n_looks_passed", n_looks_passed);
  visit("mould/on_plates", on_plates);
  visit("mould/on_side", on_side);
  visit("mould/unbalance", unbalance);
  if (auto read = visit_grains(visit, grains.get(), parameters.shrinking()))
    grains = std::move(read);
}

double plate_force(const dem::Simulation &sample)
{
  return 0.5 * (sample.walls[upper_plate].force[2] - sample.walls[lower_plate].force[2]);
}

void set_plates(dem::Simulation &sample, const double speed)
{
  sample.walls[lower_plate].velocity = speed * Vec3::UnitZ();
  sample.walls[upper_plate].velocity = -speed * Vec3::UnitZ();
}

dem::Piston plate_piston(const dem::Simulation &sample, const double push, const double fastest)
{
  return {dem::piston_mass(sample.particles), push, impedances_of(sample).plate, fastest};
}

} // namespace bergamo::driver
