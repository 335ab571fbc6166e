// What a body says where its motion cannot go on: which element, where and when.

#include "dem/core/error.h"
#include "fe_dealii/moving_body.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace bergamo::fe
{
namespace
{

bool are_finite(const std::span<const double> values)
{
  return std::all_of(values.begin(), values.end(), [](const double x) { return std::isfinite(x); });
}

} // namespace

std::array<double, 3> MovingBody::reference_centre(const std::size_t element) const
{
  std::array<double, 3> centre{};
  const std::span<const unsigned int> nodes = element_nodes(element);
  for (const unsigned int node : nodes)
    for (int i = 0; i < 3; ++i)
      centre[i] += node_position_[node][i] / nodes.size();
  return centre;
}

std::array<double, 3> MovingBody::present_centre(const std::size_t element) const
{
  std::array<double, 3> centre = reference_centre(element);
  const std::span<const unsigned int> nodes = element_nodes(element);
  for (const unsigned int node : nodes)
    for (int i = 0; i < 3; ++i)
      centre[i] += displacement_[3 * std::size_t(node) + i] / nodes.size();
  return centre;
}

std::string MovingBody::describe(const std::size_t element) const
{
  std::array<double, 3> centre = present_centre(element);
  if (!are_finite(centre))
    centre = reference_centre(element);
  std::ostringstream text;
  text << name_ << ": element " << element << " at (" << centre[0] << ", " << centre[1] << ", " << centre[2]
       << ") m has, at time " << time() << " s,";
  return text.str();
}

void MovingBody::report_failure(const std::size_t element) const
{
  throw RunError(describe(element) + " " + elements_->failure(element));
}

void MovingBody::report_endless_forces() const
{
  const std::size_t n = elements_->dofs_per_element();
  std::size_t element = 0;
  while (element + 1 < n_elements() && are_finite(elements_->forces().subspan(n * element, n)))
    ++element;
  throw RunError(describe(element) + " forces that are no finite numbers; look for what is none in the motion of its "
                                     "nodes, or choose a smaller time step");
}

void MovingBody::report_endless_motion() const
{
  std::size_t dof = 0;
  while (dof + 1 < velocity_.size() && std::isfinite(velocity_[dof]) && std::isfinite(external_force_[dof]))
    ++dof;
  const std::size_t node = dof / 3;
  std::ostringstream message;
  message << describe(slots_[node].empty() ? 0 : slots_[node].front() / elements_->nodes_per_element()) << " a node, "
          << node << ", under " << external_force_[dof] << " N that is sent to move at " << velocity_[dof]
          << " m/s; look for what is no finite number in loads and prescribed motions, or choose a smaller time step";
  throw RunError(message.str());
}

} // namespace bergamo::fe
