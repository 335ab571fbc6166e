#pragma once

#include "dem/loading/loading_stage.h"
#include "dem/measure/inertial_number.h"
#include "dem/simulation/simulation.h"

#include <cstdint>

namespace bergamo::dem
{

/// Walls of a periodic cell (Wellmann 5.1.3), fit to its grains: t_w is a tenth of their mean radius. The
/// dissertation's hundredth at a damping ratio of 0.1 is lighter than the dashpots of the contacts bear: the walls then
/// shake.
CellControlParameters cell_walls_for(const MeanGrain &grain, double density);

/// Leads a simulation in a periodic cell through one stage. A step is prepare(), then what is to be read of the step,
/// then Simulation::integrate().
class CellLoading
{
public:
  /// What a restart needs.
  struct State
  {
    Vec3 edges = Vec3::Zero();   ///< at the start of the stage [m]
    Vec3 applied = Vec3::Zero(); ///< stress on the walls [Pa]
    double start_time = 0.;      ///< [s]
    double leg = 0.;             ///< under way
    double n_checks_passed = 0.; ///< in a row

    template <class Self, class Visit>
    static void visit_state(Self &self, Visit &visit)
    {
      visit("edges", self.edges);
      visit("applied", self.applied);
      visit("start_time", self.start_time);
      visit("leg", self.leg);
      visit("n_checks_passed", self.n_checks_passed);
    }
  };

  /// @param stage valid; @param grain of the simulation; @param density of the grains [kg/m^3]
  CellLoading(const LoadingStage &stage, const MeanGrain &grain, double density);

  /// Begins the stage: takes the present edges for reference, sets friction and time step.
  void begin(Simulation &simulation);

  /// Goes on after a restart.
  void resume(const State &state);

  /// Forces of this step, and what the cell does next. @throws RunError after the longest time
  void prepare(Simulation &simulation);

  bool is_finished() const;

  /// Engineering strains since the start of the stage.
  Vec3 strain(const Simulation &simulation) const;

  /// From 0 to 1: of the strain, or of the pressure.
  double progress(const Simulation &simulation) const;

  const LoadingStage &stage() const { return s; }
  const State &state() const { return now; }
  double rate() const { return strain_rate; } ///< of the axis, or the largest of an axis under stress [1/s]

private:
  void check_rest(Simulation &simulation, const Vec3 &stress);
  void follow_stable_step(Simulation &simulation) const;

  LoadingStage s;
  CellControl control;
  double strain_rate;
  State now;
};

} // namespace bergamo::dem
