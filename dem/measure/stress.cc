#include "dem/measure/stress.h"

#include "dem/core/error.h"

#include <cmath>
#include <vector>

namespace bergamo::dem
{

Mat3 force_moment(const std::span<const TouchingContact> contacts)
{
  Mat3 sum = Mat3::Zero();
  for (const TouchingContact &contact : contacts)
    sum += contact.branch * force_on_body1(contact).transpose();
  return sum;
}

Mat3 mean_stress(const std::span<const TouchingContact> contacts, const double volume)
{
  require(volume > 0. && std::isfinite(volume), "volume of the stress", volume, "positive and finite [m^3]");
  return force_moment(contacts) / volume;
}

Mat3 mean_stress(const std::span<const TouchingContact> contacts, const Particles &particles,
                 const Eigen::AlignedBox3d &cell)
{
  std::vector<TouchingContact> inside;
  for (const TouchingContact &contact : contacts)
  {
    const Vec3 point = contact_point(contact, particles);
    if ((point.array() >= cell.min().array()).all() && (point.array() < cell.max().array()).all())
      inside.push_back(contact);
  }
  return mean_stress(inside, cell.isEmpty() ? 0. : cell.volume());
}

} // namespace bergamo::dem
