#include "dem/law/hertz.h"

#include "dem/core/tangent_frame.h"
#include "dem/state/material.h"

#include <boost/math/special_functions/ellint_rd.hpp>
#include <boost/math/special_functions/ellint_rf.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace bergamo::dem
{
namespace
{

using Mat2 = Eigen::Matrix2d;

/// Eigenvalues low <= high of a symmetric 2x2 matrix and the unit eigenvector of low.
struct Eigen2
{
  double low, high;
  Eigen::Vector2d low_direction;

  explicit Eigen2(const Mat2 &m)
  {
    const double mean = 0.5 * (m(0, 0) + m(1, 1)), half = 0.5 * (m(0, 0) - m(1, 1));
    const double radius = std::hypot(half, m(0, 1));
    low = mean - radius;
    high = mean + radius;
    // Of the two equivalent rows take the one that does not cancel.
    const Eigen::Vector2d v =
        half > 0. ? Eigen::Vector2d(-m(0, 1), half + radius) : Eigen::Vector2d(radius - half, -m(0, 1));
    const double length = v.norm();
    low_direction = length > 0. ? Eigen::Vector2d(v / length) : Eigen::Vector2d(1., 0.);
  }
};

Mat2 bounded_curvature(const TangentFrame &frame, const Mat3 &hessian, const CurvatureBounds &bounds)
{
  const Mat2 radii = frame.transpose() * hessian * frame;
  const Eigen2 e(radii);
  const double low = 1. / std::clamp(e.low, bounds.smallest_radius, bounds.largest_radius);
  const double high = 1. / std::clamp(e.high, bounds.smallest_radius, bounds.largest_radius);
  return high * Mat2::Identity() + (low - high) * e.low_direction * e.low_direction.transpose();
}

RelativeCurvature from_sum(const TangentFrame &frame, const Mat2 &curvature)
{
  const Eigen2 e(curvature);
  return {0.5 * e.low, 0.5 * e.high, frame * e.low_direction};
}

/// Functions of the ratio b/a alone.
struct EllipseShape
{
  double force;     ///< kappa sqrt(E / K^3)
  double semi_axis; ///< sqrt(D (1 + b/a) / K): major semi-axis = semi_axis sqrt(delta / (a + b))
  double k, bm, d;  ///< K, B = K - D and D = (K - E) / e^2
};

/// @param log_kappa logarithm of the ratio of the semi-axes, >= 0
/// Carlson's forms take 1 - e^2 = 1/kappa^2 itself, so nothing cancels for long ellipses.
EllipseShape ellipse(const double log_kappa, double &curvature_ratio)
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

EllipseShape ellipse_at(const double log_ratio)
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

class EllipseTable
{
public:
  EllipseTable()
  {
    for (int i = 0; i < n; ++i)
      entries[i] = ellipse_at(std::max(i - 1, 0) * step); // entry 0 only completes the first stencil
    // Extend evenly to the left: all functions are smooth in log(b/a) through 0, use a cubic through the next four.
    const auto extend = [&](auto member)
    {
      entries[0].*member =
          4. * entries[1].*member - 6. * entries[2].*member + 4. * entries[3].*member - entries[4].*member;
    };
    extend(&EllipseShape::force);
    extend(&EllipseShape::semi_axis);
    extend(&EllipseShape::k);
    extend(&EllipseShape::bm);
    extend(&EllipseShape::d);
  }

  EllipseShape operator()(const double log_ratio) const
  {
    const double x = std::clamp(log_ratio, 0., log_max) / step;
    const int cell = std::min(static_cast<int>(x), n - 4);
    const double t = x - cell;
    // Cubic Lagrange weights of the points -1, 0, 1, 2.
    const std::array<double, 4> w{-t * (t - 1) * (t - 2) / 6, (t + 1) * (t - 1) * (t - 2) / 2,
                                  -(t + 1) * t * (t - 2) / 2, (t + 1) * t * (t - 1) / 6};
    EllipseShape result{0., 0., 0., 0., 0.};
    for (int i = 0; i < 4; ++i)
    {
      const EllipseShape &e = entries[cell + i];
      result.force += w[i] * e.force;
      result.semi_axis += w[i] * e.semi_axis;
      result.k += w[i] * e.k;
      result.bm += w[i] * e.bm;
      result.d += w[i] * e.d;
    }
    return result;
  }

private:
  static constexpr int n = 2048;
  static constexpr double log_max = 23.025850929940457; // log 1e10
  static constexpr double step = log_max / (n - 3);
  std::array<EllipseShape, n> entries;
};

} // namespace

RelativeCurvature relative_curvature(const Vec3 &normal, const Mat3 &hessian1, const CurvatureBounds &bounds1,
                                     const Mat3 &hessian2, const CurvatureBounds &bounds2)
{
  const auto frame = tangent_frame(normal);
  return from_sum(frame, bounded_curvature(frame, hessian1, bounds1) + bounded_curvature(frame, hessian2, bounds2));
}

RelativeCurvature relative_curvature(const Vec3 &normal, const Mat3 &hessian, const CurvatureBounds &bounds)
{
  const auto frame = tangent_frame(normal);
  return from_sum(frame, bounded_curvature(frame, hessian, bounds));
}

ElasticPair elastic_pair(const Material &m1, const Material &m2)
{
  const double compliance1 = (1. + m1.poisson_ratio) / m1.young_modulus;
  const double compliance2 = (1. + m2.poisson_ratio) / m2.young_modulus;
  return {1. / (compliance1 * (1. - m1.poisson_ratio) + compliance2 * (1. - m2.poisson_ratio)),
          compliance1 + compliance2, m1.poisson_ratio * compliance1 + m2.poisson_ratio * compliance2};
}

HertzMindlin hertz_mindlin(const double a, const double b, const ElasticPair &pair)
{
  static const EllipseTable table;
  const EllipseShape shape = table(std::log(b / a));
  const double sum = a + b;
  const double semi_axis = shape.semi_axis / std::sqrt(sum); // times sqrt(delta)
  return {2. / 3. * std::numbers::pi * shape.force / std::sqrt(sum) * pair.effective_modulus,
          std::numbers::pi * semi_axis / (shape.k * pair.lambda1 - shape.bm * pair.lambda2),
          std::numbers::pi * semi_axis / (shape.k * pair.lambda1 - shape.d * pair.lambda2)};
}

} // namespace bergamo::dem
