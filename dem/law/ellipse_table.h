#pragma once

#include "dem/core/pack.h"

#include <array>
#include <vector>

namespace bergamo::dem
{

/// What Hertz' and Mindlin's laws need of a contact ellipse, functions of the curvature ratio b/a alone. K and E are
/// the complete elliptic integrals, e the ellipse's eccentricity, kappa >= 1 the ratio of its semi-axes.
template <class Real>
struct EllipseShape
{
  Real force;     ///< kappa sqrt(E / K^3)
  Real semi_axis; ///< sqrt(D (1 + b/a) / K): major semi-axis = semi_axis sqrt(delta / (a + b))
  Real k, bm, d;  ///< K, Bm = K - D and D = (K - E) / e^2
};

/// Solves for the ellipse of one curvature ratio. @param log_ratio log(b/a) >= 0
EllipseShape<double> solve_ellipse(double log_ratio);

/// Ellipses over log(b/a) in [0, log 1e10] by cubic interpolation; the relative error is below 1e-8, beyond the table
/// the last entry holds.
class EllipseTable
{
public:
  EllipseTable();

  template <class Real>
  EllipseShape<Real> operator()(const Real &log_ratio) const
  {
    const Real x = math::clamp(log_ratio, Real(0.), Real(log_max)) * Real(1. / step);
    // Also for what is no number: a place in the table.
    const Real cell =
        math::map(x, [](const double x) { return static_cast<double>(static_cast<int>(x < n - 4. ? x : n - 4.)); });
    const Real t = x - cell, one(1.), two(2.);
    // Cubic Lagrange weights of the points -1, 0, 1, 2.
    const std::array<Real, 4> w{t * (t - one) * (t - two) * Real(-1. / 6.),
                                (t + one) * (t - one) * (t - two) * Real(0.5), (t + one) * t * (t - two) * Real(-0.5),
                                (t + one) * t * (t - one) * Real(1. / 6.)};
    const auto interpolate = [&](auto member)
    {
      Real sum(0.);
      for (int i = 0; i < 4; ++i)
        sum = sum + w[i] * math::map(cell, [&](const double k) { return entries[static_cast<int>(k) + i].*member; });
      return sum;
    };
    using Entry = EllipseShape<double>;
    return {interpolate(&Entry::force), interpolate(&Entry::semi_axis), interpolate(&Entry::k), interpolate(&Entry::bm),
            interpolate(&Entry::d)};
  }

private:
  static constexpr int n = 2048;
  static constexpr double log_max = 23.025850929940457; // log 1e10
  static constexpr double step = log_max / (n - 3);

  std::vector<EllipseShape<double>> entries;
};

/// The table, made at its first use.
const EllipseTable &ellipse_table();

} // namespace bergamo::dem
