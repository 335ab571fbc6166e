#include "dem/loading/compression.h"

#include "dem/core/error.h"
#include "dem/loading/piston.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace bergamo::dem
{

std::vector<PlaneWall> box_walls(const Box &box)
{
  std::vector<PlaneWall> walls(6);
  for (int d = 0; d < 3; ++d)
  {
    walls[2 * d].point = box.low;
    walls[2 * d].normal = Vec3::Unit(d);
    walls[2 * d + 1].point = box.high;
    walls[2 * d + 1].normal = -Vec3::Unit(d);
  }
  return walls;
}

Box box_between(const std::vector<PlaneWall> &walls)
{
  Box box;
  for (int d = 0; d < 3; ++d)
  {
    box.low[d] = walls[2 * d].point[d];
    box.high[d] = walls[2 * d + 1].point[d];
  }
  return box;
}

Vec3 wall_pressure(const std::vector<PlaneWall> &walls)
{
  const Vec3 edges = box_between(walls).edges();
  Vec3 pressure;
  for (int d = 0; d < 3; ++d)
    pressure[d] = 0.5 * (walls[2 * d + 1].force[d] - walls[2 * d].force[d]) * edges[d] / edges.prod();
  return pressure;
}

namespace
{

/// Sum of the impedances of each wall's contacts [N s/m].
std::vector<double> wall_impedance(const Simulation &simulation)
{
  std::vector<double> sum(simulation.walls.size(), 0.);
  for (const TouchingContact &contact : simulation.contacts.touching_walls(simulation.particles))
    if (contact.wall >= 0)
      sum[contact.wall] += impedance_of(contact);
  return sum;
}

} // namespace

void CompressionParameters::validate() const
{
  require(pressure > 0. && std::isfinite(pressure), "pressure of the compression", pressure, "positive [Pa]");
  require(largest_rate > 0. && largest_rate <= 1000., "largest strain rate of the compression", largest_rate,
          "in (0, 1000] 1/s");
  require(pressure_tolerance > 0. && pressure_tolerance < 1., "pressure tolerance", pressure_tolerance, "in (0, 1)");
  require(force_tolerance > 0. && force_tolerance < 1., "force tolerance", force_tolerance, "in (0, 1)");
  require(longest_time > 0. && std::isfinite(longest_time), "longest time of the compression", longest_time,
          "positive [s]");
}

Compression::Compression(const CompressionParameters &parameters) : p(parameters)
{
  p.validate();
}

void Compression::step(Simulation &simulation)
{
  constexpr std::int64_t check_interval = 50; // steps

  simulation.compute_forces();
  const double dt = simulation.parameters().time_step, mass = piston_mass(simulation.particles);
  const double most = speed_of_pressure(p.pressure, simulation.parameters().grain().density);
  const Vec3 pressure = wall_pressure(simulation.walls);
  const Vec3 edges = box_between(simulation.walls).edges();
  const std::vector<double> impedance = wall_impedance(simulation);
  bool pressures_hold = true;
  for (int d = 0; d < 3; ++d)
  {
    PlaneWall &low = simulation.walls[2 * d], &high = simulation.walls[2 * d + 1];
    const double miss = p.pressure - pressure[d];
    pressures_hold = pressures_hold && std::abs(miss) < p.pressure_tolerance * p.pressure;
    const Piston piston{mass, miss * edges.prod() / edges[d], 0.5 * (impedance[2 * d] + impedance[2 * d + 1]),
                        std::min(0.5 * edges[d] * p.largest_rate, most)};
    low.velocity = piston.speed_after(low.velocity[d], dt) * Vec3::Unit(d);
    high.velocity = -low.velocity;
  }
  if (simulation.n_steps % check_interval == 0)
  {
    unbalance = pressures_hold ? dem::unbalanced_force(simulation) : 1.;
    n_checks_passed = pressures_hold && unbalance < p.force_tolerance ? n_checks_passed + 1. : 0.;
  }
  simulation.integrate();
  if (simulation.time > p.longest_time)
  {
    std::ostringstream message;
    message << "the packing did not come to rest within " << p.longest_time << " s: pressures " << pressure.transpose()
            << " Pa, unbalanced force " << unbalance
            << "; allow more time, a larger tolerance or a smaller strain rate";
    throw RunError(message.str());
  }
}

double unbalanced_force(const Simulation &simulation)
{
  double resultant = 0., contact = 0.;
  std::size_t n_loaded = 0, n_contacts = 0;
  for (std::size_t i = 0; i < simulation.particles.size(); ++i)
  {
    if (simulation.particles.is_fixed(i))
      continue;
    const double f = simulation.particles.force[i].norm();
    resultant += f;
    n_loaded += f > 0.;
  }
  const auto add = [&](const ContactView &s)
  {
    contact += std::hypot(s.forces.normal, s.forces.tangential.norm());
    ++n_contacts;
  };
  for (const TouchingContact &pair : simulation.contacts.touching(simulation.particles))
    add(pair.state);
  for (const TouchingContact &contact : simulation.contacts.touching_walls(simulation.particles))
    add(contact.state);
  if (n_loaded == 0 || n_contacts == 0 || contact == 0.)
    return 1.;
  return (resultant / n_loaded) / (contact / n_contacts);
}

} // namespace bergamo::dem
