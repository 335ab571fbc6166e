#include "dem/motion/cell_control.h"

#include "dem/core/error.h"

#include <algorithm>
#include <cmath>

namespace bergamo::dem
{
namespace
{

// The applied stress is corrected while the miss is a small share of what is prescribed, so that a cell that cannot
// follow, as loose grains before they touch, winds nothing up. It is corrected at 0.03 of the rate at which the
// damper slows the walls: any rate below that one is stable, for whatever stiffness (Routh's criterion).
constexpr double correction_window = 0.1, correction_over_damping = 0.03;

} // namespace

void CellControlParameters::validate() const
{
  require(wall_density > 0. && std::isfinite(wall_density), "density of the cell's walls", wall_density,
          "positive [kg/m3]");
  require(wall_thickness > 0. && std::isfinite(wall_thickness), "thickness of the cell's walls", wall_thickness,
          "positive [m]");
  require(damping_ratio >= 0. && std::isfinite(damping_ratio), "damping ratio of the cell's walls", damping_ratio,
          "at least 0");
  require(modulus > 0. && std::isfinite(modulus), "modulus of the cell's walls", modulus, "positive [Pa]");
  require(largest_rate > 0. && std::isfinite(largest_rate), "largest strain rate of the cell", largest_rate,
          "positive [1/s]");
}

double CellControlParameters::stable_time_step(const double shortest_edge) const
{
  // Central differences, the damper implicit: 2 over the frequency of a wall on the cell's stiffness.
  return 2. * std::sqrt(wall_density * wall_thickness * shortest_edge / modulus);
}

CellControl::CellControl(const CellControlParameters &parameters) : parameters(parameters)
{
  parameters.validate();
}

void CellControl::act(PeriodicCell &cell, const std::array<AxisControl, 3> &controls, const Vec3 &mean_stress,
                      const double time_step)
{
  cell.require_closed("the control of a cell's stresses and rates");
  const double inertia = parameters.wall_density * parameters.wall_thickness;
  const double applied_step = parameters.modulus * parameters.largest_rate * time_step;
  for (int d = 0; d < 3; ++d)
  {
    const AxisControl &control = controls[d];
    double new_rate;
    if (control.kind == AxisControl::Kind::rate)
    {
      new_rate = control.value * cell.edges[d];
      applied[d] = mean_stress[d];
    }
    else
    {
      const double damping =
          parameters.damping_ratio * std::sqrt(parameters.modulus / (inertia * cell.edges[d])) * time_step;
      const double miss = control.value - mean_stress[d];
      const double approach = std::abs(miss) < correction_window * std::abs(control.value)
                                  ? correction_over_damping * 2. * damping * miss
                                  : control.value - applied[d];
      applied[d] += std::clamp(approach, -applied_step, applied_step);
      const double push = (applied[d] - mean_stress[d]) / inertia * time_step;
      const double fastest = parameters.largest_rate * cell.edges[d];
      new_rate = std::clamp((cell.rate[d] * (1. - damping) + push) / (1. + damping), -fastest, fastest);
    }
    cell.acceleration[d] = (new_rate - cell.rate[d]) / time_step;
  }
}

} // namespace bergamo::dem
