#pragma once

#include "dem/flow/outlet.h"
#include "dem/measure/grid_fit.h"
#include "dem/simulation/simulation.h"
#include "drivers/common/run/flow_sample.h"
#include "drivers/common/run/picture_series.h"
#include "drivers/silo_discharge/figures.h"
#include "drivers/silo_discharge/parameters.h"

#include <filesystem>
#include <memory>
#include <vector>

namespace bergamo::driver
{

/// A filled silo that runs out of one of its orifices.
class Discharge
{
public:
  /// @param orifice number of it
  Discharge(const SiloParameters &parameters, std::size_t orifice);

  /// Opens the orifice of a filled silo, at time 0.
  void open(std::unique_ptr<dem::Simulation> filled);

  dem::Simulation &grains() { return *simulation; }
  double time() const { return simulation->time - start_time; } ///< since the orifice was opened [s]
  double fraction() const;                                      ///< done
  bool is_over() const;                                         ///< as of the last look

  void compute(); ///< takes away what has fallen out; forces and kick

  /// @name Of the present step, between kick and drift
  /// @{
  void look(); ///< a sample: energies, loads, what has passed, velocities while the flow is steady
  void look_at_step() { flow.look_at_step(*simulation); }
  std::vector<Picture> pictures() const;
  /// @}

  Table table() const; ///< of the last look; must not outlive the discharge

  /// The figures as of the last look.
  const DischargeFigures &figures();

  /// As of the last look. mass_flow.csv: flow of each window; mean_velocity.vtu and profiles.csv: the mean velocity
  /// while the flow is steady, once there were grains enough. Throws RunError where a file cannot be written.
  void write(const std::filesystem::path &folder) const;

  void visit(StateVisitor &visit);

private:
  dem::MassFlow steady_flow() const;
  double discharged_share() const { return flow.record().mass() / start_mass; }
  void write_profiles(const std::vector<Vec3> &velocity, const std::filesystem::path &path) const;

  const SiloParameters &parameters;
  std::size_t orifice;
  std::unique_ptr<dem::Simulation> simulation;
  dem::Outlet outlet;
  FlowSample flow;
  dem::GridFit velocity;
  double start_time = 0., start_mass = 0.; // [s], [kg]
  std::vector<double> start_heights;       // by id [m]
  DischargeFigures f;
};

} // namespace bergamo::driver
