#include "dem/measure/contact_list.h"

#include <algorithm>

namespace bergamo::dem
{

std::vector<TouchingContact> touching_walls(const WallContacts &walls)
{
  std::vector<TouchingContact> contacts;
  for (std::size_t k = 0; k < walls.size(); ++k)
    if (walls.is_touching(k))
    {
      TouchingContact &contact = contacts.emplace_back();
      contact.first = walls.particle[k];
      contact.second = no_grain;
      contact.state = walls.state(k);
      contact.branch = contact.state.point;
    }
  return contacts;
}

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

double largest_relative_overlap(const PairContacts &pairs, const WallContacts &walls, const Particles &particles)
{
  return std::max(largest_relative_overlap(pairs.touching(particles), particles),
                  largest_relative_overlap(touching_walls(walls), particles));
}

} // namespace bergamo::dem
