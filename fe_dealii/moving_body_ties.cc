#include "dem/core/error.h"
#include "dem/core/parallel.h"
#include "fe_dealii/moving_body.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace bergamo::fe
{

MovingBody::Constraint MovingBody::prescribe_velocity(const unsigned int boundary_id, const unsigned int component,
                                                      const double velocity)
{
  return prescribe_velocity(boundary_nodes(boundary_id), component, velocity);
}

MovingBody::Constraint MovingBody::prescribe_velocity(const std::span<const unsigned int> nodes,
                                                      const unsigned int component, const double velocity)
{
  if (component > 2)
    reject(name_, ": component ", component, " of a prescribed velocity is not allowed; choose 0, 1 or 2 for x, y, z");
  for (const unsigned int node : nodes)
    if (node >= n_nodes())
      reject(name_, ": a velocity is prescribed at node ", node, ", but there are only ", n_nodes(), " nodes");
  const Constraint constraint(constraint_velocity_.size());
  auto &dofs = constraint_dofs_.emplace_back();
  const auto prescribe = [&](const unsigned int node)
  {
    const std::size_t dof = 3 * std::size_t(node) + component;
    if (constraint_of_dof_[dof] >= 0 && !is_held_by_dashpots(dof))
      return;
    constraint_of_dof_[dof] = static_cast<int>(constraint.place());
    dofs.push_back(dof);
  };
  for (const unsigned int node : nodes)
    if (!images_.has(node))
      prescribe(node);
  for (const NodeImages::Group &group : images_.groups())
    if (std::find_first_of(nodes.begin(), nodes.end(), group.nodes.begin(), group.nodes.end()) != nodes.end())
      std::for_each(group.nodes.begin(), group.nodes.end(), prescribe);
  constraint_velocity_.push_back(velocity);
  return constraint;
}

double MovingBody::reaction(const Constraint constraint) const
{
  double sum = 0;
  for (const unsigned int dof : constraint_dofs_[constraint.place()])
    sum += reaction_force_[dof];
  return sum;
}

void MovingBody::make_rigid(const std::span<const unsigned int> nodes)
{
  std::vector<bool> is_among(n_nodes(), false);
  for (const unsigned int node : nodes)
    is_among[node] = true;
  for (std::size_t e = 0; e < n_elements(); ++e)
  {
    const std::span<const unsigned int> own = element_nodes(e);
    if (std::all_of(own.begin(), own.end(), [&](const unsigned int node) { return is_among[node]; }))
      elements_->make_rigid(e);
  }
  progress_.has_forces = 0;
}

void MovingBody::add_dashpots(const std::span<const Dashpot> dashpots)
{
  if (progress_.n_steps > 0 || progress_.is_kicked != 0)
    reject(name_, ": dashpots are added after ", n_steps(), " steps; add them before the first");
  for (const Dashpot &dashpot : dashpots)
    if (dashpot.node >= n_nodes() || dashpot.element >= n_elements())
      reject(name_, ": a dashpot at node ", dashpot.node, " of element ", dashpot.element, ", but there are only ",
             n_nodes(), " nodes and ", n_elements(), " elements");
  for (const Dashpot &dashpot : dashpots)
    if (images_.has(dashpot.node))
      reject(name_, ": a dashpot at node ", dashpot.node, " of a face that repeats itself; put dashpots elsewhere");
  dashpots_.add(dashpots, n_nodes());
  held_force_.assign(3 * n_nodes(), 0.);
  progress_.is_rested = 0;
  if (!hold_)
    hold_ = prescribe_velocity(std::span<const unsigned int>(), 0);
  for (const unsigned int node : dashpots_.nodes())
    for (std::size_t i = 0; i < 3; ++i)
      if (int &constraint = constraint_of_dof_[3 * std::size_t(node) + i]; constraint < 0)
      {
        constraint = static_cast<int>(hold_->place());
        constraint_dofs_[hold_->place()].push_back(3 * node + i);
      }
}

void MovingBody::let_go_of_dashpots()
{
  if (progress_.n_steps == 0 && progress_.is_rested == 0)
    throw RunError(name_ + ": its first step begins with quiet boundaries that do not know what they hold; call "
                           "find_equilibrium(), or rest() where it is at rest as it is, before");
  if (hold_)
    for (const unsigned int dof : constraint_dofs_[hold_->place()])
      if (is_held_by_dashpots(dof))
        constraint_of_dof_[dof] = -1;
  hold_.reset();
  std::vector<double> factor(dashpots_.elements().size());
  parallel_for(factor.size(),
               [&](const std::size_t k)
               {
                 const std::size_t element = dashpots_.elements()[k];
                 factor[k] = std::sqrt(elements_->stiffness_factor(element) * mass_factor(element));
               });
  dashpots_.set_viscosity(factor);
}

std::array<double, 3> MovingBody::drag(const std::size_t node) const
{
  if (!dashpots_.has(node))
    return {};
  return dashpots_.drag(node, {velocity_[3 * node], velocity_[3 * node + 1], velocity_[3 * node + 2]});
}

void MovingBody::repeat(const std::array<bool, 3> is_periodic)
{
  if (!constraint_velocity_.empty() || !dashpots_.empty())
    reject(name_, ": it is to repeat itself, but velocities are prescribed or dashpots put already; let it repeat "
                  "itself first");
  images_ = NodeImages(node_position_, is_periodic);
  imaged_velocity_.assign(velocity_.size(), 0.);
}

void MovingBody::set_face_velocity(const std::array<double, 3> &velocity)
{
  for (std::size_t d = 0; d < 3; ++d)
    face_velocity_[d] = images_.is_periodic()[d] ? velocity[d] : 0.;
}

std::array<double, 3> MovingBody::face_force(const std::size_t direction) const
{
  std::array<double, 3> sum{};
  for (const NodeImages::Group &group : images_.groups())
    for (std::size_t k = 0; k < group.nodes.size(); ++k)
      for (std::size_t i = 0; i < 3; ++i)
        sum[i] += group.shift[k][direction] * reaction_force_[3 * std::size_t(group.nodes[k]) + i];
  return sum;
}

} // namespace bergamo::fe
