#pragma once

#include "drivers/strip_footing/parameters.h"
#include "fe_dealii/conditions/boundary_conditions.h"
#include "fe_dealii/equilibrium/static_equilibrium.h"
#include "fe_dealii/explicit_body.h"
#include "fe_dealii/step_control.h"

#include <memory>

namespace bergamo::driver
{

/// Elements of the ground with their stresses at rest, before the static start. Throws what mesh and material refuse.
fe::ExplicitBody make_ground(const FootingParameters &parameters);

/// Half of the ground under a strip footing, one element thick (plane strain): x from the axis, z upwards, the surface
/// at z = 0.
class FootingModel
{
public:
  /// Sets up the ground at rest. Throws what the mesh, the material and the static start refuse.
  explicit FootingModel(const FootingParameters &parameters);

  void compute_forces(); ///< of the present state; the footing's motion over the step to come, and how long that is
  void kick() { body().kick(dt); }
  void drift() { body().drift(dt); }

  /// Mean pressure under the footing, at the last kick [Pa].
  double footing_pressure() const;

  fe::ExplicitBody &body() { return *ground; }
  const fe::ExplicitBody &body() const { return *ground; }
  const fe::EquilibriumReport &start() const { return start_report; }
  double time() const { return body().time(); } ///< [s]
  double time_step() const { return dt; }       ///< to come, after compute_forces() [s]
  const fe::StepControl &steps() const { return *control; }
  fe::StepControl &steps() { return *control; }

private:
  double area; // of the half footing [m²]
  std::unique_ptr<fe::ExplicitBody> ground;
  std::unique_ptr<fe::BoundaryConditions> conditions;
  std::vector<unsigned int> footing_nodes;
  fe::EquilibriumReport start_report;
  std::unique_ptr<fe::StepControl> control;
  double share, dt = 0;
};

} // namespace bergamo::driver
