#include "dem/loading/piston.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace bergamo::dem
{

double Piston::speed_after(const double speed, const double time_step) const
{
  constexpr double absorption = 0.2; // of the contacts' impedance; 1 takes up every wave but creeps
  const double after = (mass * speed + push * time_step) / (mass + absorption * impedance * time_step);
  return std::clamp(after, -fastest, fastest); // the dashpot acts at the end of the step
}

double piston_mass(const Particles &grains)
{
  constexpr double share = 0.2; // of the packing; 0.02 of 80 grains shakes, 0.05 does not
  return share * std::accumulate(grains.mass.begin(), grains.mass.end(), 0.);
}

double speed_of_pressure(const double pressure, const double density)
{
  constexpr double share = 0.5;
  return share * std::sqrt(pressure / density);
}

double impedance_of(const TouchingContact &contact)
{
  const ContactView &s = contact.state;
  return s.weight * std::sqrt(1.5 * s.stiffness.normal * std::sqrt(s.overlap) * s.reduced_mass);
}

} // namespace bergamo::dem
