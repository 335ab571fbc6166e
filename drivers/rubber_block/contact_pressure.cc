#include "drivers/rubber_block/contact_pressure.h"

#include "dem/measure/surface_stress.h"

#include <algorithm>
#include <cmath>

namespace bergamo::driver
{
namespace
{

Vec3 area_of(const dem::Surface &surface, const std::size_t triangle)
{
  const auto &[a, b, c] = surface.topology.triangle[triangle];
  return 0.5 * (surface.node[b] - surface.node[a]).cross(surface.node[c] - surface.node[a]);
}

Vec3 centre_of(const dem::Surface &surface, const std::size_t triangle)
{
  const auto &[a, b, c] = surface.topology.triangle[triangle];
  return (surface.node[a] + surface.node[b] + surface.node[c]) / 3.;
}

double mobilized_of(const std::vector<dem::TouchingContact> &contacts, const std::span<const dem::Surface> surfaces,
                    const std::int32_t surface)
{
  double normal = 0., tangential = 0.;
  for (const dem::TouchingContact &contact : contacts)
    if (contact.feature >= 0 && dem::feature_of(surfaces, contact.feature).surface == surface)
    {
      normal += std::abs(contact.state.weight) * contact.state.forces.normal;
      tangential += std::abs(contact.state.weight) * contact.state.forces.tangential.norm();
    }
  return normal > 0. ? tangential / normal : 0.;
}

} // namespace

ContactPressure::ContactPressure(const dem::Surface &start, const std::size_t triangles_per_face, const double rear,
                                 const double length, const std::size_t n_strips)
    : per_face(triangles_per_face), of_strip(n_strips)
{
  for (std::size_t k = 0; k < start.topology.n_faces(); ++k)
  {
    const Vec3 area = area_of(start, k);
    const double share = (centre_of(start, k)[0] - rear) / length;
    const auto strip = static_cast<std::size_t>(std::clamp(share, 0., 1.) * static_cast<double>(n_strips));
    strip_of.push_back(area[2] < -0.5 * area.norm() ? std::min(strip, n_strips - 1) : n_strips);
  }
}

void ContactPressure::measure(const dem::Simulation &grains, const std::int32_t surface)
{
  const std::vector<dem::TouchingContact> contacts = grains.contacts.touching_walls(grains.particles);
  const dem::Surface &present = grains.surfaces[surface];
  const std::vector<double> pressure = dem::surface_stress(grains.surfaces, contacts)[surface].pressure;
  const std::size_t n_strips = of_strip.size();
  std::vector<double> force(n_strips + 1), area(n_strips + 1);
  of_worst_face = 0.;
  double force_of_face = 0., area_of_face = 0.;
  for (std::size_t k = 0; k < pressure.size(); ++k)
  {
    const double own_area = area_of(present, k).norm(), own_force = pressure[k] * own_area;
    force[strip_of[k]] += own_force;
    area[strip_of[k]] += own_area;
    force_of_face += own_force;
    area_of_face += own_area;
    if ((k + 1) % per_face == 0)
    {
      of_worst_face = std::max(of_worst_face, force_of_face / area_of_face);
      force_of_face = area_of_face = 0.;
    }
  }
  for (std::size_t strip = 0; strip < n_strips; ++strip)
    of_strip[strip] = area[strip] > 0. ? force[strip] / area[strip] : 0.;
  mobilized = mobilized_of(contacts, grains.surfaces, surface);
}

} // namespace bergamo::driver
