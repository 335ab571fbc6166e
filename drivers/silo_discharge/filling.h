#pragma once

#include "dem/simulation/simulation.h"
#include "drivers/common/run/energy_residual.h"
#include "drivers/common/run/table.h"
#include "drivers/silo_discharge/figures.h"
#include "drivers/silo_discharge/parameters.h"

#include <memory>
#include <string>
#include <vector>

namespace bergamo::driver
{

/// Grains that settle in the closed silo, from a loose packing in a higher box.
class Filling
{
public:
  explicit Filling(const SiloParameters &p) : parameters(p) {}

  /// Draws, places and tightens the grains. @return false where the user has interrupted that
  /// @throws ConfigError where they find no place, RunError where the tightening gets stuck
  bool begin();

  dem::Simulation &grains() { return *simulation; }
  double time() const { return simulation->time; } ///< [s]
  bool is_settled() const { return settled; }      ///< as of the last look

  /// Done, as a rough guess.
  double fraction() const;

  /// @name Of the present step, between kick and drift
  /// @{
  void look(); ///< whether the grains rest. @throws RunError after the longest time
  void measure();
  /// @}

  /// Of the grains at rest, as of the last measures.
  FillingFigures figures() const;

  /// Drifts on to the next step, and out it comes.
  std::unique_ptr<dem::Simulation> take();

  Table table() const; ///< of the last measures; must not outlive the filling

  void visit(StateVisitor &visit);

private:
  double fall_time() const;

  const SiloParameters &parameters;
  std::unique_ptr<dem::Simulation> simulation;
  bool settled = false;
  double kinetic_share = 1.; // of a grain, over its weight times its diameter
  dem::GrainEnergy energy;
  std::vector<dem::SurfaceLoad> loads;
  EnergyResidual residual;
};

/// Names of the silo's surfaces while it is filled, and while it discharges, without the plugs.
/// @{
std::vector<std::string> closed_surface_names(const SiloParameters &parameters);
std::vector<std::string> open_surface_names(const SiloParameters &parameters);
/// @}

} // namespace bergamo::driver
