#pragma once

#include "coupling/adapter/model_energy.h"
#include "dem/measure/part_loads.h"
#include "drivers/common/run/energy_residual.h"
#include "drivers/common/run/table.h"
#include "drivers/common/summary.h"
#include "drivers/pile_installation/installation.h"

#include <vector>

namespace bergamo::driver
{

/// What is measured of an installation, sample by sample, and what it comes to.
class InstallationMeasures
{
public:
  explicit InstallationMeasures(const InstallationParameters &p) : parameters(p) {}

  /// A sample, of the present step, between compute() and move(). @param time since the pile is there [s]
  /// @throws RunError where the run has diverged or the pile has come to the end of the block
  void look(const Installation &installation, double time);

  Table table() const; ///< of the last sample; must not outlive this
  void add_to(Summary &summary) const;
  double energy_residual() const { return residual.relative(); }
  double largest_overlap() const { return largest_overlap_; } ///< over the radius, of all samples

  void visit(StateVisitor &visit);

private:
  const dem::PartLoad &tip() const { return loads[tip_part]; }
  const dem::PartLoad &shaft() const { return loads[shaft_part]; }
  double tip_pressure() const { return tip().force[2] / parameters.shape().tip_area(); }

  const InstallationParameters &parameters;
  double time = 0., way = 0., depth = 0.; // [s], [m], [m]
  std::vector<dem::PartLoad> loads = std::vector<dem::PartLoad>(2);
  double head_force = 0., bottom_force = 0.;                      // [N]
  double grain_motion = 0., element_motion = 0., difference = 0.; // [m]
  double solid_fraction_below = 0., coordination = 0., unbalanced = 0., overlap = 0.;
  double largest_overlap_ = 0., largest_head_force = 0.;
  coupling::ModelEnergy energy;
  double pile_work = 0.; // [J]
  EnergyResidual residual;
};

} // namespace bergamo::driver
