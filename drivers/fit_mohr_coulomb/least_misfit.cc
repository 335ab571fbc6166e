#include "drivers/fit_mohr_coulomb/least_misfit.h"

#include "dem/core/error.h"

#include <unsupported/Eigen/NonLinearOptimization>
#include <unsupported/Eigen/NumericalDiff>

#include <algorithm>
#include <cmath>

namespace bergamo::driver
{
namespace
{

using Vector = Eigen::VectorXd;

/// What MINPACK asks: the differences at some unknowns.
struct Differences
{
  using Scalar = double;
  using InputType = Vector;
  using ValueType = Vector;
  using JacobianType = Eigen::MatrixXd;
  enum
  {
    InputsAtCompileTime = Eigen::Dynamic,
    ValuesAtCompileTime = Eigen::Dynamic
  };

  const std::vector<SandTest> &tests;
  const CurvesByUnknowns &curves;
  int n_inputs, n_values;

  int inputs() const { return n_inputs; }
  int values() const { return n_values; }

  /// Where there is no such law everything is far off: the step is taken back.
  int operator()(const Vector &x, Vector &difference) const
  {
    difference.setConstant(n_values, 10);
    try
    {
      const std::vector<double> found = differences(tests, curves(x));
      if (std::all_of(found.begin(), found.end(), [](const double d) { return std::isfinite(d); }))
        std::copy(found.begin(), found.end(), difference.data());
    }
    catch (const ConfigError &)
    {
    }
    catch (const RunError &)
    {
    }
    return 0;
  }
};

Differences differences_of(const std::vector<SandTest> &tests, const CurvesByUnknowns &curves, const Vector &unknowns)
{
  std::size_t n_values = 0;
  for (const SandTest &test : tests)
    n_values += 2 * test.shear.size() + test.compression.size();
  return {tests, curves, static_cast<int>(unknowns.size()), static_cast<int>(n_values)};
}

} // namespace

double Bounded::number(const double value) const
{
  const double share = std::clamp(std::log(value / least) / std::log(most / least), 1e-3, 1 - 1e-3);
  return std::log(share / (1 - share));
}

double Bounded::value(const double number) const
{
  return least * std::pow(most / least, 1 / (1 + std::exp(-number)));
}

double misfit_at(const std::vector<SandTest> &tests, const CurvesByUnknowns &curves, const Vector &unknowns)
{
  Vector difference;
  differences_of(tests, curves, unknowns)(unknowns, difference);
  return difference.norm();
}

Vector least_misfit(const std::vector<SandTest> &tests, const CurvesByUnknowns &curves, Vector start)
{
  // Differences over 1e-4 of an unknown: the paths are true to 1e-8.
  Eigen::NumericalDiff<Differences> with_slopes(differences_of(tests, curves, start), 1e-8);
  Eigen::LevenbergMarquardt<Eigen::NumericalDiff<Differences>> method(with_slopes);
  method.parameters.maxfev = 400;
  method.parameters.xtol = method.parameters.ftol = 1e-8;
  method.minimize(start);
  return start;
}

} // namespace bergamo::driver
