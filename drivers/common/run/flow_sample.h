#pragma once

#include "dem/measure/mass_flow.h"
#include "dem/simulation/simulation.h"
#include "drivers/common/run/discharge_record.h"
#include "drivers/common/run/energy_residual.h"
#include "drivers/common/run/table.h"

#include <filesystem>
#include <limits>
#include <string>
#include <vector>

namespace bergamo::driver
{

/// What is sampled of grains that run out of an orifice among surfaces: energies, loads on the surfaces, what has
/// passed, and how good the steps are.
class FlowSample
{
public:
  /// @param behind where grains are that have passed
  explicit FlowSample(const dem::HalfSpace &behind) : record_(behind) {}

  /// A sample of the present step, between kick and drift. @param time of the discharge [s]; @param removed by an
  /// outlet. Throws RunError for an overlap that says that the run has diverged.
  void look(const dem::Simulation &grains, double time, const dem::Throughput &removed = {});

  /// At the stable step, too.
  void look_at_step(const dem::Simulation &grains);

  const DischargeRecord &record() const { return record_; }
  std::vector<dem::SurfaceLoad> &loads() { return loads_; }      ///< of the last sample, by surface
  double stable_step() const { return stable_step_; }            ///< shortest of all looks [s]
  double largest_overlap() const { return largest_overlap_; }    ///< over the radius, of all samples
  double energy_residual() const { return residual.relative(); } ///< over the work of gravity

  /// All of the last sample but its time; must not outlive this. @param names of the surfaces
  std::vector<Column> columns(const std::vector<std::string> &names) const;

  void visit(StateVisitor &visit);

private:
  DischargeRecord record_;
  dem::GrainEnergy energy;
  std::vector<dem::SurfaceLoad> loads_;
  EnergyResidual residual;
  double stable_step_ = std::numeric_limits<double>::infinity(), largest_overlap_ = 0.;
};

/// The windows of a flow as a table: begin, end, flow. Throws RunError as write_csv() does.
void write_windows(const std::filesystem::path &path, const dem::MassFlow &flow);

} // namespace bergamo::driver
