#pragma once

#include "coupling/adapter/body_mover.h"
#include "coupling/adapter/grains_mover.h"
#include "coupling/model/model.h"
#include "drivers/beam_impact/parameters.h"
#include "drivers/beam_impact/trajectory.h"
#include "drivers/common/run/state_visitor.h"

#include <memory>
#include <vector>

namespace bergamo::driver
{

/// A sphere that touches the middle of a beam of elements, free of weight, and flies towards it. Its ends are held
/// across the axis, all over their faces, which may turn.
class Impact
{
public:
  explicit Impact(const ImpactParameters &parameters);

  /// @name One step
  /// @{
  void compute(); ///< forces and kick
  void look();    ///< takes the present step into way()
  void move();
  /// @}

  double time_step() const { return step; } ///< [s]
  double time() const { return simulation().time; }
  std::int64_t n_steps() const { return simulation().n_steps; }
  double stable_step() const { return model->stable_steps().combined(); } ///< [s]

  double sphere_velocity() const { return -simulation().particles.velocity[0][2]; } ///< towards the beam [m/s]
  coupling::MoverEnergy energy_of_sphere() const { return grains->energy(); } ///< with the contact's, after compute()
  coupling::MoverEnergy energy_of_beam() const { return beam->energy(); }
  const Trajectory &way() const { return looked; }

  const dem::Simulation &simulation() const { return grains->simulation(); }
  const fe::ExplicitBody &body() const { return beam->solid(); }

  void visit(StateVisitor &visit);

private:
  dem::SimulationParameters simulation_parameters() const;
  std::unique_ptr<dem::Simulation> sphere_at_start() const;
  void set_up(std::unique_ptr<dem::Simulation> sphere);
  double sphere_displacement() const;
  double beam_displacement() const;
  double force() const;

  const ImpactParameters &parameters;
  std::unique_ptr<coupling::Model> model;
  coupling::GrainsMover *grains = nullptr;
  coupling::SolidMover *beam = nullptr;
  double step = 0.;                  // [s]
  std::vector<unsigned int> section; // nodes in the middle of the beam
  Trajectory looked;
};

} // namespace bergamo::driver
