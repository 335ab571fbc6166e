#pragma once

#include "coupling/adapter/model_energy.h"
#include "coupling/adapter/two_scale_model.h"
#include "drivers/common/progress.h"
#include "drivers/common/run/placed_intruder.h"
#include "drivers/common/run/rotation_watch.h"
#include "drivers/pile_installation/start.h"
#include "fe_dealii/step_control.h"

#include <memory>
#include <optional>
#include <vector>

namespace bergamo::driver
{

/// Sand about a pile that is pressed into it: grains, around them elements where the ground has two scales, joined by
/// an overlap at the sides and the bottom of the block of grains, and the pile, a rigid body in contact with the
/// grains.
class Installation
{
public:
  /// @param sand with the parameters of the installation, and with the pile's surface where it was stored with it
  /// @param start must outlive it; it follows the block as that grows
  /// @throws ConfigError where the time step is above the stable one of the elements
  Installation(const InstallationParameters &parameters, std::unique_ptr<dem::Simulation> sand,
               InstallationStart &start);

  /// Brings the elements to rest under what the grains of the overlap put on them. Ground too weak to bear that starts
  /// as it is, with a warning. Call once, before the first step. Needs MPI for two scales, see run_with_mpi().
  void settle(Progress &progress);

  /// @name One step
  /// @{
  /// Forces and kick; before them the block may grow. @param time since the pile is there [s]
  void compute(double time);
  void move() { model.drift(); }
  /// @}

  const coupling::TwoScaleModel &models() const { return model; } ///< grains, elements and what joins them
  const dem::Simulation &sand() const { return *model.grains(); }
  const fe::ExplicitBody *body() const { return model.body(); } ///< of elements; none for grains alone
  const dem::SurfaceParts &parts() const { return pile.parts; }
  const InstallationStart &start() const { return begun; }
  const std::optional<GroundPlan> &plan() const { return plan_; }        ///< of two scales, as it is now
  double lowest() const { return pile.mover->body().centre()[2]; }       ///< height of the tip [m]
  double stable_step() const { return model.stable_steps().combined(); } ///< [s]

  /// @name Between compute() and move()
  /// @{
  double head_force() const; ///< that drives the pile, downwards [N]
  double pile_work() const;  ///< of the pile on the grains since the start [J]
  coupling::ModelEnergy energy() const { return coupling::energy_of(model); }            ///< without the pile's own
  double largest_difference() const { return model.penalty_state().largest_difference; } ///< of both models [m]
  double bottom_force() const;           ///< of the ground on what bears it below, downwards [N]
  double largest_grain_motion() const;   ///< since the start, of any grain [m]
  double largest_element_motion() const; ///< the same, of any node; 0 without elements [m]
  double unbalanced() const;             ///< mean resultant of the grains over the mean contact force
  /// @}

  std::int64_t n_renewals() const { return model.coupling() ? model.coupling()->n_renewals() : 0; } ///< of the overlap

  /// Warns once where strains of the elements are too small a description for their rotation.
  void look_at_rotation(Progress &progress);
  double greatest_rotation() const { return rotation.greatest(); } ///< [degrees]

  /// All but the grains, which the constructor gets, and the start, into which it puts the overlap's present places.
  void visit(StateVisitor &visit);

  /// Of the overlap as it is now, for the start that a restart is made with.
  const std::vector<Vec3> *reference_by_id() const
  {
    return model.overlap() ? &model.overlap()->reference_by_id() : nullptr;
  }

private:
  void hold_elements();
  void join();
  std::vector<double> nodal_weight() const;
  bool must_grow() const;
  void grow();
  std::vector<Vec3> motion_of_ground(std::span<const Vec3> places) const;

  const InstallationParameters &parameters;
  InstallationStart &begun;
  std::optional<GroundPlan> plan_; // at the start, and then as it has grown
  coupling::TwoScaleModel model;
  PlacedIntruder pile;
  std::optional<fe::StepControl> body_steps;
  std::optional<fe::ExplicitBody::Constraint> floor; ///< of the elements
  std::vector<double> displacement_at_start;         ///< of the nodes [m]
  RotationWatch rotation;
  double applied_force = 0.; ///< on the head, downwards, of the present step [N]
};

} // namespace bergamo::driver
