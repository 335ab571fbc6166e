#include "fe_dealii/equilibrium/static_equilibrium.h"

#include "dem/core/error.h"
#include "fe_dealii/equilibrium/tangent_system.h"
#include "fe_dealii/explicit_body.h"
#include "fe_dealii/material/elastic_parameters.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <vector>

namespace bergamo::fe
{
namespace
{

/// A body's state, to return to.
class SavedState
{
public:
  explicit SavedState(ExplicitBody &body) : body(body)
  {
    for (const auto &[name, view] : body.state())
      values.emplace_back(view.begin(), view.end());
  }

  void restore() const
  {
    const auto views = body.state();
    for (std::size_t k = 0; k < values.size(); ++k)
      std::copy(values[k].begin(), values[k].end(), views[k].second.begin());
  }

private:
  ExplicitBody &body;
  std::vector<std::vector<double>> values;
};

double norm(const std::vector<double> &x)
{
  double square = 0;
  for (const double component : x)
    square += component * component;
  return std::sqrt(square);
}

class Newton
{
public:
  Newton(ExplicitBody &body, const EquilibriumParameters &parameters)
      : body(body), p(parameters), start(body), system(body, parameters.direct_limit), n_dofs(3 * body.n_nodes()),
        u(body.displacement().begin(), body.displacement().end()), u_start(u), moved(n_dofs, 0.), residual(n_dofs),
        pull(n_dofs), increment(n_dofs)
  {
    for (std::size_t dof = 0; dof < n_dofs; ++dof)
      if (const auto constraint = body.constraint_of(dof))
        moved[dof] = p.duration * body.prescribed_velocity(*constraint);
  }

  EquilibriumReport run()
  {
    try
    {
      iterate();
    }
    catch (...)
    {
      start.restore();
      throw;
    }
    body.rest();
    return report;
  }

private:
  /// Brings the body from its state at the start to a displacement. @return out-of-balance over acting forces
  double bring_to(const std::vector<double> &displacement)
  {
    start.restore();
    std::copy(displacement.begin(), displacement.end(), body.displacement().begin());
    try
    {
      body.compute_internal_force();
    }
    catch (const RunError &) // turned inside out: too far
    {
      return std::numeric_limits<double>::infinity();
    }
    double internal = 0, applied = 0;
    for (std::size_t dof = 0; dof < n_dofs; ++dof)
    {
      const double force = body.external_force()[dof] + body.weight(dof);
      internal += body.internal_force()[dof] * body.internal_force()[dof];
      applied += force * force;
      residual[dof] = body.constraint_of(dof) ? 0 : force - body.internal_force()[dof];
    }
    const double out_of_balance = norm(residual);
    return out_of_balance == 0 ? 0 : out_of_balance / std::sqrt(std::max(internal, applied));
  }

  void iterate()
  {
    const bool moves = std::any_of(moved.begin(), moved.end(), [](const double x) { return x != 0; });
    double error = bring_to(u);
    report.residual.push_back(error);
    for (int iteration = 0; !(error <= p.tolerance) || (moves && iteration == 0); ++iteration)
    {
      if (iteration == p.max_iterations)
        fail("after " + std::to_string(iteration) + " iterations");
      std::vector<double> load = residual;
      start.restore();
      // The first step is elastic: where all flows, the tangent of a zero increment is singular.
      if (iteration == 0)
      {
        system.assemble_elastic(u.data(), moved, pull);
        for (std::size_t dof = 0; dof < n_dofs; ++dof)
          load[dof] += pull[dof];
      }
      else
      {
        std::fill(moved.begin(), moved.end(), 0.);
        system.assemble_tangent(u.data(), u_start.data());
      }
      constexpr double linear_tolerance = 1e-8; // keeps Newton's digits until they are those of the balance
      report.n_linear_iterations += system.solve(load, linear_tolerance, increment);
      error = advance(error, moves && iteration == 0);
      report.residual.push_back(error);
    }
  }

  /// Goes along the increment as far as the forces come into better balance. @param in_full whatever the balance: the
  /// prescribed dofs have to get where they are to be
  double advance(const double error_before, const bool in_full)
  {
    constexpr int most_halvings = 8;
    std::vector<double> trial(n_dofs), best;
    double least = std::numeric_limits<double>::infinity();
    double share = 1;
    for (int k = 0; k <= most_halvings; ++k, share /= 2)
    {
      for (std::size_t dof = 0; dof < n_dofs; ++dof)
        trial[dof] = u[dof] + moved[dof] + share * increment[dof];
      const double error = bring_to(trial);
      if (error < least)
      {
        least = error;
        best = trial;
      }
      if (error < (1 - 1e-4 * share) * error_before || (in_full && std::isfinite(error)))
        break;
    }
    if (best.empty())
      fail("because an element turns inside out");
    u = best;
    return bring_to(u);
  }

  [[noreturn]] void fail(const std::string &reason) const
  {
    std::size_t worst = 0;
    for (std::size_t dof = 1; dof < n_dofs; ++dof)
      if (std::abs(residual[dof]) > std::abs(residual[worst]))
        worst = dof;
    const auto &place = body.node_position()[worst / 3];
    std::ostringstream message;
    message << "static equilibrium: none found " << reason << "; " << report.residual.back()
            << " of the forces stay out of balance, most at node " << worst / 3 << " at (" << place[0] << ", "
            << place[1] << ", " << place[2] << ") m. The body may not bear the load: lower it, apply it in smaller "
            << "increments, or strengthen the material";
    throw RunError(message.str());
  }

  ExplicitBody &body;
  const EquilibriumParameters &p;
  SavedState start;
  TangentSystem system;
  std::size_t n_dofs;
  std::vector<double> u, u_start, moved, residual, pull, increment;
  EquilibriumReport report;
};

} // namespace

void EquilibriumParameters::validate() const
{
  const auto require = [](const bool holds, const char *name, const double value, const char *rule)
  { require_parameter(holds, "static equilibrium", name, value, rule); };
  require(tolerance > 0 && tolerance < 1, "tolerance", tolerance, "choose it between 0 and 1");
  require(max_iterations >= 1, "max_iterations", max_iterations, "give at least 1");
  require(std::isfinite(duration), "duration [s]", duration, "give a number");
}

EquilibriumReport find_equilibrium(ExplicitBody &body, const EquilibriumParameters &parameters)
{
  parameters.validate();
  return Newton(body, parameters).run();
}

} // namespace bergamo::fe
