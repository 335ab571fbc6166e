#include "fe_dealii/equilibrium/static_equilibrium.h"

#include "dem/core/error.h"
#include "fe_dealii/equilibrium/rigid_motions.h"
#include "fe_dealii/equilibrium/tangent_system.h"
#include "fe_dealii/explicit_body.h"
#include "fe_dealii/material/elastic_parameters.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace bergamo::fe
{
namespace
{

/// A body's state, to return to.
class SavedState
{
public:
  explicit SavedState(ExplicitBody &b) : body(b) { save(); }

  void save()
  {
    values.clear();
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

double dot(const std::vector<double> &a, const std::vector<double> &b)
{
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.);
}

bool is_zero(const std::vector<double> &x)
{
  return std::all_of(x.begin(), x.end(), [](const double component) { return component == 0; });
}

/// Newton's method over increments of the path from what is out of balance at the start, and of the prescribed motions.
/// An increment that has no equilibrium is cut in half; one that has is followed by one twice as long.
class Newton
{
public:
  Newton(ExplicitBody &body, const EquilibriumParameters &parameters)
      : body(body), p(parameters), start(body), increment_start(start), system(body, parameters.direct_limit),
        n_dofs(3 * body.n_nodes()), u(body.displacement().begin(), body.displacement().end()), u_start(u),
        motion(n_dofs, 0.), moved(n_dofs), unbalanced(n_dofs, 0.), residual(n_dofs), pull(n_dofs), increment(n_dofs)
  {
    for (std::size_t dof = 0; dof < n_dofs; ++dof)
      if (const auto constraint = body.constraint_of(dof))
        motion[dof] = p.duration * body.prescribed_velocity(*constraint);
  }

  EquilibriumReport run()
  {
    try
    {
      report.residual.push_back(bring_to(u, 1));
      if (!is_zero(motion) || !(report.residual.back() <= p.tolerance))
      {
        unbalanced = residual;
        follow_path();
      }
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
  void follow_path()
  {
    double reached = 0, length = 1;
    while (reached < 1)
    {
      const double next = std::min(1., reached + length);
      if (const std::string failure = try_increment(reached, next); failure.empty())
      {
        reached = next;
        length *= 2;
        ++report.n_increments;
      }
      else if ((length = 0.5 * (next - reached)) < p.least_increment)
      {
        if (reached < p.least_share)
          fail(failure, reached);
        report.borne = reached;
        report.left = bring_to(u_start, 1);
        bring_to(u_start, reached);
        return;
      }
    }
  }

  /// Brings the body from its state at the start of the increment to a displacement.
  /// @param share of the path whose loads act
  /// @return out-of-balance over acting forces; infinite where the displacement goes too far for any forces
  double bring_to(const std::vector<double> &displacement, const double share)
  {
    increment_start.restore();
    std::copy(displacement.begin(), displacement.end(), body.displacement().begin());
    try
    {
      body.compute_internal_force();
    }
    catch (const RunError &)
    {
      return std::numeric_limits<double>::infinity();
    }
    double internal = 0, applied = 0;
    for (std::size_t dof = 0; dof < n_dofs; ++dof)
    {
      const double force =
          body.external_force()[dof] + body.weight(dof) + body.held_force(dof) - (1 - share) * unbalanced[dof];
      internal += body.internal_force()[dof] * body.internal_force()[dof];
      applied += force * force;
      residual[dof] = body.constraint_of(dof) ? 0 : force - body.internal_force()[dof];
    }
    for (const NodeImages::Group &group : body.images().groups()) // act together
      for (std::size_t k = 1; k < group.nodes.size(); ++k)
        for (std::size_t i = 0; i < 3; ++i)
          residual[3 * std::size_t(group.nodes[0]) + i] +=
              std::exchange(residual[3 * std::size_t(group.nodes[k]) + i], 0.);
    const double out_of_balance = std::sqrt(dot(residual, residual));
    return out_of_balance == 0 ? 0 : out_of_balance / std::sqrt(std::max(internal, applied));
  }

  /// @return why there is no equilibrium; nothing where there is, and then the body is in it
  std::string try_increment(const double from, const double to)
  {
    constexpr int patience = 10; // iterations in which the balance has to gain
    constexpr double lost = 100; // times as bad: near incompressibility it gets worse by less on its way
    u = u_start;
    for (std::size_t dof = 0; dof < n_dofs; ++dof)
      moved[dof] = (to - from) * motion[dof];
    double error = bring_to(u, to), error_earlier = HUGE_VAL, worst_start = error;
    for (int iteration = 0; !(error <= p.tolerance) || (iteration == 0 && !is_zero(moved)); ++iteration)
    {
      const bool is_stuck = iteration % patience == 0 && iteration > 0 && error > 0.5 * error_earlier;
      if (iteration == p.max_iterations || is_stuck)
        return "after " + std::to_string(iteration) + " iterations";
      if (iteration % patience == 0 && iteration > 0)
        error_earlier = error;
      if (const std::string failure = iterate(iteration, to, error); !failure.empty())
        return failure;
      report.residual.push_back(error);
      if (iteration == 0)
        worst_start = std::max(worst_start, error);
      else if (error > lost * worst_start)
        return "as the iterations go astray";
    }
    increment_start.save();
    u_start = u;
    return "";
  }

  /// One step of Newton's method. The first is elastic: where all flows, the tangent of a zero increment is singular.
  std::string iterate(const int iteration, const double share, double &error)
  {
    std::vector<double> load = residual;
    increment_start.restore();
    try
    {
      if (iteration == 0)
      {
        system.assemble_elastic(u.data(), moved, pull);
        for (std::size_t dof = 0; dof < n_dofs; ++dof)
          load[dof] += pull[dof];
      }
      else
        system.assemble_tangent(u.data(), u_start.data());
      constexpr double linear_tolerance = 1e-8; // keeps Newton's digits until they are those of the balance
      report.n_linear_iterations += system.solve(load, linear_tolerance, increment);
    }
    catch (const RunError &)
    {
      return "because the stiffness is singular on the way";
    }
    // With prescribed motions the first step is taken in full: they have to get where they are to be.
    const bool moves = iteration == 0 && !is_zero(moved);
    const double length = moves ? 1 : search_along(share, error);
    for (std::size_t dof = 0; dof < n_dofs; ++dof)
      u[dof] += (moves ? moved[dof] : 0) + length * increment[dof];
    error = bring_to(u, share);
    return std::isfinite(error) ? "" : "because an element turns inside out";
  }

  /// How far to go along the increment: to where the forces do no more work on it, which is the least energy of an
  /// elastic body (Matthies and Strang, Int. J. Numer. Meth. Eng. 14 (1979) 1613-1626). The balance may get worse on
  /// the way, as it does near incompressibility. Where the increment does not lower the energy, to the best balance.
  double search_along(const double share, const double error_before)
  {
    constexpr int most_trials = 10;
    constexpr double little = 0.8; // of the work at the start
    const double work_at_start = dot(increment, residual);
    const bool is_descent = work_at_start > 0;
    std::vector<double> trial(n_dofs);
    double low = 0, high = 1, work_low = work_at_start, at = 1, best = 1;
    double least = std::numeric_limits<double>::infinity();
    for (int k = 0; k < most_trials; ++k)
    {
      for (std::size_t dof = 0; dof < n_dofs; ++dof)
        trial[dof] = u[dof] + at * increment[dof];
      const double error = bring_to(trial, share);
      if (error < least)
      {
        least = error;
        best = at;
      }
      if (error < 0.5 * error_before) // Newton's own progress
        return at;
      const bool is_finite = std::isfinite(error);
      const double work = is_finite ? dot(increment, residual) : -work_at_start;
      if (is_descent && is_finite && (std::abs(work) <= little * work_at_start || (k == 0 && work > 0)))
        return at;
      const double secant = low + (at - low) * work_low / (work_low - work);
      if (is_descent && work > 0)
      {
        low = at;
        work_low = work;
      }
      else
        high = at;
      at = is_descent && is_finite && secant > low + 0.1 * (high - low) && secant < high - 0.1 * (high - low)
               ? secant
               : 0.5 * (low + high);
    }
    return best;
  }

  [[noreturn]] void fail(const std::string &reason, const double reached) const
  {
    std::size_t worst = 0;
    for (std::size_t dof = 1; dof < n_dofs; ++dof)
      if (std::abs(residual[dof]) > std::abs(residual[worst]))
        worst = dof;
    const auto &place = body.node_position()[worst / 3];
    std::ostringstream message;
    message << "static equilibrium: none found " << reason << "; " << 100 * reached
            << " % of the way to the loads and motions is borne, beyond it " << report.residual.back()
            << " of the forces stay out of balance, most at node " << worst / 3 << " at (" << place[0] << ", "
            << place[1] << ", " << place[2]
            << ") m. The body may not bear the load: lower it, or strengthen the material";
    throw RunError(message.str());
  }

  ExplicitBody &body;
  const EquilibriumParameters &p;
  SavedState start, increment_start;
  TangentSystem system;
  std::size_t n_dofs;
  std::vector<double> u, u_start; // present, at the start of the increment
  std::vector<double> motion;     // of the prescribed dofs over the whole path
  std::vector<double> moved;      // over the increment
  std::vector<double> unbalanced; // forces at the start of the path
  std::vector<double> residual, pull, increment;
  EquilibriumReport report;
};

} // namespace

void EquilibriumParameters::validate() const
{
  const auto require = [](const bool holds, const char *name, const double value, const char *rule)
  { require_parameter(holds, "static equilibrium", name, value, rule); };
  require(tolerance > 0 && tolerance < 1, "tolerance", tolerance, "choose it between 0 and 1");
  require(max_iterations >= 1, "max_iterations", max_iterations, "give at least 1");
  require(least_increment > 0 && least_increment <= 1, "least_increment", least_increment,
          "choose it above 0, and 1 at most");
  require(least_share >= 0 && least_share <= 1, "least_share", least_share, "choose it from 0 to 1");
  require(std::isfinite(duration), "duration [s]", duration, "give a number");
}

EquilibriumReport find_equilibrium(ExplicitBody &body, const EquilibriumParameters &parameters)
{
  parameters.validate();
  if (std::find(body.mass().begin(), body.mass().end(), 0.) != body.mass().end())
    reject("continuum: it has absent elements (ExplicitBody::set_share()), which have no equilibrium; bring it to rest "
           "before they are left out");
  if (parameters.duration != 0 && !body.images().empty())
    reject("static equilibrium: motions over ", parameters.duration,
           " s are prescribed of a body that repeats itself; its faces have to rest: choose a duration of 0");
  require_held(body);
  return Newton(body, parameters).run();
}

} // namespace bergamo::fe
