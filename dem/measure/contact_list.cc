#include "dem/measure/contact_list.h"

#include "dem/core/error.h"

#include <algorithm>

namespace bergamo::dem
{

Vec3 contact_point(const TouchingContact &contact, const Particles &particles)
{
  const Vec3 arm = contact.second == no_grain ? contact.branch : Vec3(0.5 * contact.branch + contact.state.point);
  return particles.position[contact.first] + arm;
}

double largest_relative_overlap(const std::span<const TouchingContact> contacts, const Particles &particles)
{
  double largest = 0.;
  for (const TouchingContact &c : contacts)
  {
    double radius = particles.bounding_radius[c.first];
    if (c.second != no_grain)
      radius = std::min(radius, particles.bounding_radius[c.second]);
    largest = std::max(largest, c.state.overlap / radius);
  }
  return largest;
}

double largest_relative_overlap(const Contacts &contacts, const Particles &particles)
{
  return std::max(largest_relative_overlap(contacts.touching(particles), particles),
                  largest_relative_overlap(contacts.touching_walls(particles), particles));
}

void check_overlap(const double relative_overlap, const double time, const std::string &remedy)
{
  constexpr double largest = 0.2;
  if (relative_overlap <= largest)
    return;
  std::ostringstream message;
  message << "the run diverged: grains overlap by " << relative_overlap << " of their radius at time " << time
          << " s; choose " << remedy;
  throw RunError(message.str());
}

} // namespace bergamo::dem
