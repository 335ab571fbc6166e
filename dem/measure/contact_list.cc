#include "dem/measure/contact_list.h"

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

} // namespace bergamo::dem
