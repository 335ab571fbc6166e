#include "fe_dealii/step_control.h"

#include "dem/core/error.h"
#include "dem/core/parallel.h"
#include "fe_dealii/element/largest_eigenvalue.h"
#include "fe_dealii/moving_body.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace bergamo::fe
{
namespace
{

// A step that grew and shrank with every wave would feed energy into the fastest modes.
constexpr double fastest_growth = 1.01;
constexpr double tolerated_motion = 0.005; // of the least distance of two nodes of an element

} // namespace

StepControl::StepControl(const MovingBody &body)
    : body_(body), eigenvalue_(body.n_elements()), present_(body.n_elements())
{
  if (body.elements().stiffens_with_displacement())
  {
    displacement_.resize(body.n_elements() * body.elements().dofs_per_element());
    tolerance_.resize(body.n_elements());
  }
  parallel_for(body.n_elements(), [&](const std::size_t e) { find_eigenvalue(e); });
  look();
}

void StepControl::find_eigenvalue(const std::size_t element)
{
  eigenvalue_[element] = largest_eigenvalue(body_.elements(), element, body_.displacement().data()) /
                         (body_.mass_factor(element) * body_.elements().stiffness_factor(element));
  if (displacement_.empty())
    return;
  const std::span<const unsigned int> nodes = body_.element_nodes(element);
  for (std::size_t k = 0; k < nodes.size(); ++k)
    for (std::size_t i = 0; i < 3; ++i)
      displacement_[3 * (nodes.size() * element + k) + i] = body_.displacement()[3 * std::size_t(nodes[k]) + i];
  tolerance_[element] = tolerated_motion * shortest_distance(element);
}

double StepControl::shortest_distance(const std::size_t element) const
{
  const std::span<const unsigned int> nodes = body_.element_nodes(element);
  const auto place = [&](const unsigned int node, const std::size_t i)
  { return body_.node_position()[node][i] + body_.displacement()[3 * std::size_t(node) + i]; };
  double least_square = std::numeric_limits<double>::infinity();
  for (std::size_t a = 0; a < nodes.size(); ++a)
    for (std::size_t b = 0; b < a; ++b)
    {
      double square = 0;
      for (std::size_t i = 0; i < 3; ++i)
        square += std::pow(place(nodes[a], i) - place(nodes[b], i), 2);
      least_square = std::min(least_square, square);
    }
  return std::sqrt(least_square);
}

bool StepControl::has_deformed(const std::size_t element) const
{
  const std::span<const unsigned int> nodes = body_.element_nodes(element);
  const double *const before = &displacement_[3 * nodes.size() * element];
  const std::span<const double> now = body_.displacement();
  const double tolerance = tolerance_[element];
  bool is_near = true;
  for (std::size_t i = 0; i < 3; ++i)
  {
    const double carried = now[3 * std::size_t(nodes[0]) + i] - before[i]; // with the element as a whole
    for (std::size_t k = 1; k < nodes.size(); ++k)
      is_near &= std::abs(now[3 * std::size_t(nodes[k]) + i] - before[3 * k + i] - carried) <= tolerance;
  }
  return !is_near; // also where one is not finite
}

void StepControl::look()
{
  parallel_for(body_.n_elements(),
               [&](const std::size_t e)
               {
                 if (!displacement_.empty() && has_deformed(e))
                   find_eigenvalue(e);
                 present_[e] = eigenvalue_[e] * body_.elements().stiffness_factor(e);
               });
  double largest = 0;
  std::size_t element = 0;
  for (std::size_t e = 0; e < present_.size(); ++e)
  {
    if (!std::isfinite(present_[e]))
      throw RunError(body_.describe(e) + " a stiffness that is no finite number; look for what is none in the motion "
                                         "of its nodes, or choose a smaller share of the stable step");
    if (present_[e] > largest)
    {
      largest = present_[e];
      element = e;
    }
  }
  stable_ = {2 / std::sqrt(largest), largest, element};
  kept_.smallest_stable =
      kept_.smallest_stable > 0 ? std::min(kept_.smallest_stable, stable_.time_step) : stable_.time_step;
}

double StepControl::next(const double share)
{
  require(share > 0 && share < 1, "step control: the share of the stable step", share, "between 0 and 1");
  look();
  double step = share * stable_.time_step;
  if (kept_.last_step > 0)
    step = std::min(step, fastest_growth * kept_.last_step);
  kept_.last_step = step;
  kept_.smallest_step = kept_.smallest_step > 0 ? std::min(kept_.smallest_step, step) : step;
  return step;
}

void StepControl::require_stable(const double time_step)
{
  look();
  if (time_step <= stable_.time_step)
    return;
  std::ostringstream message;
  message << body_.describe(stable_.element) << " become so stiff that only steps up to " << stable_.time_step
          << " s are stable, less than the time step of " << time_step
          << " s; choose a smaller time step, larger elements there, or mass scaling";
  throw RunError(message.str());
}

std::vector<std::pair<std::string, std::span<double>>> StepControl::state()
{
  static_assert(sizeof(Kept) % sizeof(double) == 0);
  return {{"eigenvalue", eigenvalue_},
          {"eigenvalue_displacement", displacement_},
          {"eigenvalue_tolerance", tolerance_},
          {"kept", {reinterpret_cast<double *>(&kept_), sizeof(Kept) / sizeof(double)}}};
}

} // namespace bergamo::fe
