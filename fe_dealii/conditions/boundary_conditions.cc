#include "fe_dealii/conditions/boundary_conditions.h"

#include "dem/core/error.h"
#include "fe_dealii/conditions/quiet_boundary.h"

#include <deal.II/base/types.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

namespace bergamo::fe
{
namespace
{

constexpr std::pair<const char *, ConditionKind> kinds[] = {{"displacement", ConditionKind::displacement},
                                                            {"velocity", ConditionKind::velocity},
                                                            {"traction", ConditionKind::traction},
                                                            {"pressure", ConditionKind::pressure},
                                                            {"quiet", ConditionKind::quiet}};

bool has_component(const ConditionKind kind)
{
  return kind != ConditionKind::pressure && kind != ConditionKind::quiet;
}

[[noreturn]] void reject(const std::string &text, const std::string &reason)
{
  throw ConfigError("boundary condition '" + text + "': " + reason +
                    "; write BOUNDARY displacement|velocity|traction x|y|z FUNCTION, BOUNDARY pressure FUNCTION or "
                    "BOUNDARY quiet, such as 5 displacement z -0.01*t");
}

/// "5 displacement z -0.01*t": as parse_condition() reads it.
std::string text_of(const BoundaryCondition &condition)
{
  std::string text = std::to_string(condition.boundary_id);
  for (const auto &[name, value] : kinds)
    if (condition.kind == value)
      text += std::string(" ") + name;
  if (has_component(condition.kind))
    text += std::string(" ") + "xyz"[condition.component];
  return condition.kind == ConditionKind::quiet ? text : text + " " + condition.value.text();
}

bool is_motion(const ConditionKind kind)
{
  return kind == ConditionKind::displacement || kind == ConditionKind::velocity;
}

} // namespace

BoundaryCondition parse_condition(const std::string &text)
{
  BoundaryCondition condition;
  std::istringstream words(text);
  long long id;
  std::string kind;
  if (!(words >> id) || id < 0)
    reject(text, "it does not begin with the number of a boundary");
  if (id >= dealii::numbers::internal_face_boundary_id)
    reject(text, std::to_string(id) + " is no number of a boundary, which end at " +
                     std::to_string(dealii::numbers::internal_face_boundary_id - 1));
  condition.boundary_id = id;
  words >> kind;
  bool known = false;
  for (const auto &[name, value] : kinds)
    if (kind == name)
    {
      condition.kind = value;
      known = true;
    }
  if (!known)
    reject(text, "'" + kind + "' is no kind of condition");
  if (has_component(condition.kind))
  {
    std::string component;
    words >> component;
    const std::size_t place = std::string("xyz").find(component);
    if (component.size() != 1 || place == std::string::npos)
      reject(text, "'" + component + "' is no component");
    condition.component = place;
  }
  std::string function;
  std::getline(words >> std::ws, function);
  if (condition.kind == ConditionKind::quiet)
  {
    if (!function.empty())
      reject(text, "nothing follows the word quiet, but '" + function + "' does");
    return condition;
  }
  if (function.empty())
    reject(text, "the function of the time is missing");
  condition.value = TimeFunction(function);
  return condition;
}

BoundaryConditions::BoundaryConditions(ExplicitBody &body, std::vector<BoundaryCondition> conditions) : body(body)
{
  for (BoundaryCondition &condition : conditions)
  {
    Part part{std::move(condition), {}, {}};
    const BoundaryCondition &c = part.condition;
    if (c.component > 2)
      throw ConfigError("boundary condition: component " + std::to_string(c.component) +
                        " is not allowed; choose 0, 1 or 2 for x, y, z");
    if (is_motion(c.kind))
    {
      check_motion(c);
      part.constraint = body.prescribe_velocity(c.boundary_id, c.component);
    }
    else if (c.kind != ConditionKind::quiet)
      part.load.emplace(boundary_surface(body.dof_handler(), c.boundary_id), body.node_position());
    parts.push_back(std::move(part));
  }
  std::vector<Dashpot> dashpots;
  for (const Part &part : parts)
    if (part.condition.kind == ConditionKind::quiet)
    {
      check_quiet(part.condition);
      const std::vector<Dashpot> of_part = quiet_boundary(body, part.condition.boundary_id);
      dashpots.insert(dashpots.end(), of_part.begin(), of_part.end());
    }
  if (!dashpots.empty())
    body.add_dashpots(dashpots);
}

void BoundaryConditions::check_quiet(const BoundaryCondition &condition) const
{
  const std::string text = text_of(condition);
  for (const Part &other : parts)
    if (&other.condition != &condition && other.condition.kind == ConditionKind::quiet &&
        other.condition.boundary_id == condition.boundary_id)
      throw ConfigError("boundary condition '" + text + "': the boundary is made quiet twice; leave one of them out");
  const std::vector<unsigned int> nodes = body.boundary_nodes(condition.boundary_id);
  if (std::all_of(nodes.begin(), nodes.end(),
                  [&](const unsigned int node)
                  {
                    const std::size_t dof = 3 * std::size_t(node);
                    return body.constraint_of(dof) && body.constraint_of(dof + 1) && body.constraint_of(dof + 2);
                  }))
    throw ConfigError("boundary condition '" + text +
                      "': other conditions hold all nodes of the boundary along all axes; leave one of them out");
}

void BoundaryConditions::check_motion(const BoundaryCondition &condition) const
{
  const std::string text = text_of(condition);
  constexpr double rounding = 1e-12; // [m]
  if (condition.kind == ConditionKind::displacement && std::abs(condition.value(0)) > rounding)
    throw ConfigError("boundary condition '" + text + "': the displacement begins with " +
                      TimeFunction(condition.value(0)).text() +
                      " m, which the boundary would have to reach at once; let it begin with 0, as in " +
                      condition.value.text() + "*min(t/0.1, 1)");
  for (const Part &other : parts)
    if (is_motion(other.condition.kind) && other.condition.boundary_id == condition.boundary_id &&
        other.condition.component == condition.component)
      throw ConfigError("boundary condition '" + text + "': the boundary has '" + text_of(other.condition) +
                        "' along the same axis already; leave one of them out");
  const std::vector<unsigned int> nodes = body.boundary_nodes(condition.boundary_id);
  if (std::all_of(nodes.begin(), nodes.end(),
                  [&](const unsigned int node)
                  { return body.constraint_of(3 * std::size_t(node) + condition.component).has_value(); }))
    throw ConfigError("boundary condition '" + text +
                      "': conditions before it hold all nodes of the boundary along that axis; leave it out, or put it "
                      "before them");
}

void BoundaryConditions::apply(const double time, const double dt)
{
  require(dt > 0 && std::isfinite(dt), "boundary conditions: the time step", dt, "a positive number of seconds");
  const std::span<double> force = body.external_force();
  const std::span<const double> displacement = body.displacement();
  for (const Part &part : parts)
  {
    const TimeFunction &value = part.condition.value;
    switch (part.condition.kind)
    {
    case ConditionKind::displacement:
      body.set_velocity(*part.constraint, (value(time + dt) - value(time)) / dt);
      break;
    case ConditionKind::velocity: // lives at half steps
      body.set_velocity(*part.constraint, value(time + 0.5 * dt));
      break;
    case ConditionKind::traction:
    {
      std::array<double, 3> traction{};
      traction[part.condition.component] = value(time);
      part.load->add_traction(traction, force);
      break;
    }
    case ConditionKind::pressure:
      part.load->add_pressure(value(time), displacement, force);
      break;
    case ConditionKind::quiet:
      break;
    }
  }
}

} // namespace bergamo::fe
