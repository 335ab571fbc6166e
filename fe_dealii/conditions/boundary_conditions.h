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
  pressure,     ///< that follows the surface [Pa]
  quiet         ///< lets waves leave, see quiet_boundary(); holds like a wall until the first step
};

/// What is prescribed on a boundary over time.
struct BoundaryCondition
{
  unsigned int boundary_id = 0;
  ConditionKind kind = ConditionKind::displacement;
  unsigned int component = 0; ///< 0, 1, 2 = x, y, z; without meaning for a pressure and a quiet boundary
  TimeFunction value = 0.;    ///< without meaning for a quiet boundary
};

/// Reads "5 displacement z -0.01*min(t, 1)", "3 velocity x 0", "1 traction y 2e4*t", "4 pressure 1e5", "1 quiet".
/// Throws ConfigError.
BoundaryCondition parse_condition(const std::string &text);

/// Moves and loads the boundaries of a body as prescribed over time. A dof belongs to the first condition that names
/// it, so that edges may be shared; quiet boundaries take what the others leave. With these the body has to be brought
/// to rest, by find_equilibrium() or MovingBody::rest(), between this and the first step: what they hold then they hold
/// on.
class BoundaryConditions
{
public:
  /// Throws ConfigError for a boundary that the mesh lacks or a component above 2, for a displacement that does not
  /// begin with 0, and for what has no effect: a second motion of a boundary along the same axis, one of nodes that are
  /// all held by others, or a boundary that is made quiet twice or is held along all axes.
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
  void check_quiet(const BoundaryCondition &condition) const;

  ExplicitBody &body;
  std::vector<Part> parts;
};

} // namespace bergamo::fe
