#include "dem/measure/grain_pressure.h"

#include "dem/measure/contact_list.h"

namespace bergamo::dem
{

std::vector<double> grain_pressures(const Particles &particles, const std::span<const TouchingContact> pairs,
                                    const std::span<const TouchingContact> walls)
{
  std::vector<double> pressure(particles.size(), 0.); // times three volumes, until the end
  for (const TouchingContact &contact : pairs)
  {
    const Vec3 force = force_on_body1(contact), arm = contact.state.point + 0.5 * contact.branch;
    pressure[contact.first] -= arm.dot(force);
    pressure[contact.second] += (arm - contact.branch).dot(force);
  }
  for (const TouchingContact &contact : walls)
    pressure[contact.first] -= contact.branch.dot(force_on_body1(contact));
  for (std::size_t i = 0; i < pressure.size(); ++i)
    pressure[i] /= 3. * particles.volume[i];
  return pressure;
}

} // namespace bergamo::dem
