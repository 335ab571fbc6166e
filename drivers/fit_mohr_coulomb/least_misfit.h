#pragma once

#include "drivers/fit_mohr_coulomb/law_misfit.h"

#include <Eigen/Core>

#include <functional>
#include <vector>

namespace bergamo::driver
{

/// An unknown between bounds, as a number without: its logarithm goes from one to the other by a logistic curve.
struct Bounded
{
  double least, most; ///< > 0

  double number(double value) const;
  double value(double number) const;
};

/// The curves of a law on all tests, by its unknowns as numbers without bounds. May throw ConfigError or RunError where
/// no law has these parameters, or one has no such path.
using CurvesByUnknowns = std::function<std::vector<LawCurves>(const Eigen::VectorXd &)>;

/// Norm of differences() between a law and the grains; large where there is no such law.
double misfit_at(const std::vector<SandTest> &tests, const CurvesByUnknowns &curves, const Eigen::VectorXd &unknowns);

/// The unknowns whose differences() have the least sum of squares, by the method of Levenberg and Marquardt (MINPACK's,
/// in Eigen) from a start.
Eigen::VectorXd least_misfit(const std::vector<SandTest> &tests, const CurvesByUnknowns &curves, Eigen::VectorXd start);

} // namespace bergamo::driver
