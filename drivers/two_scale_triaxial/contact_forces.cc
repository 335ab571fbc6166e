#include "drivers/two_scale_triaxial/contact_forces.h"

#include "drivers/common/csv_table.h"

#include <cmath>
#include <numbers>
#include <vector>

namespace bergamo::driver
{

void write_contact_forces(const std::filesystem::path &path, const dem::Simulation &grains, const Layout &layout)
{
  const dem::Particles &p = grains.particles;
  std::vector<std::vector<double>> rows;
  for (const dem::TouchingContact &contact : grains.contacts.touching(p))
  {
    if (!is_of_grains_alone(layout, p.position[contact.first]) ||
        !is_of_grains_alone(layout, p.position[contact.second]))
      continue;
    const Vec3 force = contact.state.force();
    const double magnitude = force.norm();
    if (magnitude == 0.)
      continue;
    const auto angle_to = [&](const int axis)
    { return std::acos(std::min(1., std::abs(force[axis]) / magnitude)) * 180. / std::numbers::pi; };
    rows.push_back({magnitude, angle_to(0), angle_to(1), angle_to(2)});
  }
  write_csv(path, {"force_N", "angle_to_x_deg", "angle_to_y_deg", "angle_to_z_deg"}, rows);
}

} // namespace bergamo::driver
