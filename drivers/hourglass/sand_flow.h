#pragma once

#include "drivers/common/run/flow_sample.h"
#include "drivers/common/run/picture_series.h"
#include "drivers/common/summary.h"
#include "drivers/hourglass/parameters.h"

#include <filesystem>
#include <memory>
#include <vector>

namespace bergamo::driver
{

/// Sand that falls and flows through the neck of an hourglass, from a packing above it.
class SandFlow
{
public:
  explicit SandFlow(const HourglassParameters &parameters);

  /// Packs the sand. @return false where the user has interrupted that
  /// @throws ConfigError where the grains find no place, RunError where the tightening gets stuck
  bool begin();

  dem::Simulation &grains() { return *simulation; }
  std::int64_t n_grains() const { return static_cast<std::int64_t>(simulation->particles.size()); }
  double time() const { return simulation->time; } ///< [s]
  double fraction() const;                         ///< done
  bool is_over() const;                            ///< as of the last look

  /// @name Of the present step, between kick and drift
  /// @{
  void look();
  void look_at_step() { flow.look_at_step(*simulation); }
  std::vector<Picture> pictures() const;
  /// @}

  Table table() const; ///< of the last look; must not outlive it

  /// As of the last look. Throws RunError as write_csv() does.
  void write_windows(const std::filesystem::path &path) const { driver::write_windows(path, steady_flow()); }

  void add_figures(Summary &summary, RunFigures run) const;

  void visit(StateVisitor &visit);

private:
  dem::MassFlow steady_flow() const;
  double passed_share() const { return flow.record().mass() / mass; }
  double above_neck() const;

  const HourglassParameters &parameters;
  std::unique_ptr<dem::Simulation> simulation;
  FlowSample flow;
  std::vector<double> start_heights; // by id [m]
  double mass = 0.;                  // of all grains [kg]
  double load_share = 0.;            // on the glass, over the weight
  /// Sums over the samples of the steady flow.
  double n_steady = 0., sum_of_load_shares = 0., sum_of_masses = 0.;
};

} // namespace bergamo::driver
