#include "dem/law/ellipse_table.h"

#include <boost/math/special_functions/ellint_rd.hpp>
#include <boost/math/special_functions/ellint_rf.hpp>

#include <algorithm>
#include <cmath>

namespace bergamo::dem
{
namespace
{

/// @param log_kappa logarithm of the ratio of the semi-axes, >= 0
/// Carlson's forms take 1 - e^2 = 1/kappa^2 itself, so nothing cancels for long ellipses.
EllipseShape<double> ellipse(const double log_kappa, double &curvature_ratio)
{
  const double kappa = std::exp(log_kappa);
  const double complement = 1. / (kappa * kappa); // 1 - e^2
  const double k = boost::math::ellint_rf(0., complement, 1.);
  const double d = boost::math::ellint_rd(0., complement, 1.) / 3.;
  const double bm = k - d;
  const double e_integral = bm + complement * d; // E = B + (1 - e^2) D
  curvature_ratio = kappa * kappa * bm / d;      // (kappa^2 E - K) / (K - E)
  return {kappa * std::sqrt(e_integral / (k * k * k)), std::sqrt(d * (1. + curvature_ratio) / k), k, bm, d};
}

} // namespace

EllipseShape<double> solve_ellipse(const double log_ratio)
{
  double low = 0., high = log_ratio, ratio = 0.; // 1 <= kappa <= b/a
  for (int i = 0; i < 100 && high - low > 1e-15 * high; ++i)
  {
    const double middle = 0.5 * (low + high);
    ellipse(middle, ratio);
    (std::log(ratio) < log_ratio ? low : high) = middle;
  }
  return ellipse(0.5 * (low + high), ratio);
}

EllipseTable::EllipseTable() : entries(n)
{
  for (int i = 0; i < n; ++i)
    entries[i] = solve_ellipse(std::max(i - 1, 0) * step); // entry 0 only completes the first stencil
  // Extend evenly to the left: all functions are smooth in log(b/a) through 0, use a cubic through the next four.
  const auto extend = [&](auto member)
  {
    entries[0].*member =
        4. * entries[1].*member - 6. * entries[2].*member + 4. * entries[3].*member - entries[4].*member;
  };
  using Entry = EllipseShape<double>;
  for (auto member : {&Entry::force, &Entry::semi_axis, &Entry::k, &Entry::bm, &Entry::d})
    extend(member);
}

const EllipseTable &ellipse_table()
{
  static const EllipseTable table;
  return table;
}

} // namespace bergamo::dem
