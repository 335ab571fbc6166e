#pragma once

#include "fe_dealii/boundary/surface_load.h"
#include "fe_dealii/conditions/time_function.h"
#include "fe_dealii/explicit_body.h"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace bergamo::fe
{

enum class ConditionKind
{
  displacement, ///< of one component, from where the boundary is at time 0 [m]
  velocity,     ///< of one component [m/s]
  traction,     ///< one component of a dead load on the reference area [Pa]
  pressure      ///< that follows the surface [Pa]
};

/// What is prescribed on a boundary over time.
struct BoundaryCondition
{
  unsigned int boundary_id = 0;
  ConditionKind kind = ConditionKind::displacement;
  unsigned int component = 0; ///< 0, 1, 2 = x, y, z; without meaning for a pressure
  TimeFunction value = 0.;
};

/// Reads "5 displacement z -0.01*min(t, 1)", "3 velocity x 0", "1 traction y 2e4*t", "4 pressure 1e5".
/// Throws ConfigError.
BoundaryCondition parse_condition(const std::string &text);

/// Moves and loads the boundaries of a body as prescribed over time. A dof belongs to the first condition that names
/// it, so that edges may be shared.
class BoundaryConditions
{
public:
  /// Throws ConfigError for a boundary that the mesh lacks or a component above 2, for a displacement that does not
  /// begin with 0, and for a motion that has no effect: a second one of a boundary along the same axis, or one of nodes
  /// that are all held by others.
  BoundaryConditions(ExplicitBody &body, std::vector<BoundaryCondition> conditions);

  /// To be called in every step, after clear_external_force() and before kick(): adds the loads of this time and sets
  /// the velocities of the step to come. @param time, dt [s]; ConfigError for a step that is not positive and finite,
  /// RunError where a function is not finite
  void apply(double time, double dt);

  /// Force of the boundary on the body in the component that a condition prescribes, at the last kick [N].
  /// Precondition: the condition is a displacement or a velocity.
  double reaction(std::size_t condition) const { return body.reaction(*parts.at(condition).constraint); }

private:
  struct Part
  {
    BoundaryCondition condition;
    std::optional<ExplicitBody::Constraint> constraint; ///< of a motion
    std::optional<SurfaceLoad> load;                    ///< of a load
  };

  void check_motion(const BoundaryCondition &condition) const;

  ExplicitBody &body;
  std::vector<Part> parts;
};

} // namespace bergamo::fe
