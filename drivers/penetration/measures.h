#pragma once

#include "dem/measure/coordination.h"
#include "dem/measure/part_loads.h"
#include "drivers/common/run/energy_residual.h"
#include "drivers/common/run/momentum_residual.h"
#include "drivers/common/run/settled_sand.h"
#include "drivers/common/run/table.h"
#include "drivers/common/summary.h"
#include "drivers/penetration/depth_trend.h"
#include "drivers/penetration/intrusion.h"

namespace bergamo::driver
{

/// What is measured of a penetration, sample by sample, and what it comes to.
class PenetrationMeasures
{
public:
  /// @param sand as it was when the intruder came; must stay where it is
  PenetrationMeasures(const PenetrationParameters &parameters, const SettledSand &sand)
      : parameters(parameters), sand(sand)
  {
  }

  /// @name Of the present step, between compute() and move()
  /// @{
  void look(const Intrusion &intrusion, double time);                    ///< a sample
  void look_at_step(const Intrusion &i) { momentum.add_step(i.sand()); } ///< at every one, after its sample
  /// @}

  Table table() const; ///< of the last sample; must not outlive this
  void add_to(Summary &summary) const;
  double energy_residual() const { return residual.relative(); }
  double largest_overlap() const { return largest_overlap_; } ///< over the radius, of all samples

  void visit(StateVisitor &visit);

private:
  const dem::PartLoad &tip() const { return loads[tip_part]; }
  const dem::PartLoad &shaft() const { return loads[shaft_part]; }
  Vec3 force() const { return tip().force + shaft().force; }
  Vec3 moment() const; // about the lowest point of the intruder
  double tip_pressure() const { return tip().force[2] / parameters.shape().tip_area(); }
  double bulk_weight() const; // of the settled sand [N/m³]

  const PenetrationParameters &parameters;
  const SettledSand &sand;
  double time = 0., lowest = 0., weight = 0.; // [s], [m], [N]
  std::vector<dem::PartLoad> loads = std::vector<dem::PartLoad>(2);
  double floor_force = 0., sides_force = 0., drive_force = 0.; // [N]
  dem::CoordinationNumbers coordination;
  double rattler_fraction = 0., solid_fraction_below = 0., inertial_number = 0., overlap = 0.;
  double largest_overlap_ = 0., largest_shaft_friction = 0.;
  dem::GrainEnergy energy;
  double drive_work = 0.; // [J]
  EnergyResidual residual;
  MomentumResidual momentum;
  DepthTrend trend; // of the tip's pressure, from a width of the intruder on
};

} // namespace bergamo::driver
