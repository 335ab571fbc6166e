#include "dem/geometry/superquadric.h"

#include "dem/core/error.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace bergamo::dem
{
namespace
{

/// sign(x) |x|^p, the power of Barr's parametrisation.
double signed_power(const double x, const double p)
{
  return std::copysign(std::pow(std::abs(x), p), x);
}

double beta_integral(const double x, const double y)
{
  return std::exp(std::lgamma(x) + std::lgamma(y) - std::lgamma(x + y));
}

/// Largest distance from the centre on the curve |x/a|^(2/eps) + |y/b|^(2/eps) = 1.
/// Stationary points: the axes and tan(phi) = (a/b)^(1/(eps-1)) [m].
double largest_plane_radius(const double a, const double b, const double eps)
{
  double radius = std::max(a, b);
  if (eps < 1.) // for eps >= 1 the curve lies inside the larger axis' circle
  {
    const double phi = std::atan(std::pow(a / b, 1. / (eps - 1.)));
    radius = std::max(radius, std::hypot(a * std::pow(std::cos(phi), eps), b * std::pow(std::sin(phi), eps)));
  }
  return radius;
}

} // namespace

void Superquadric::validate() const
{
  using namespace shape_limits;
  for (int d = 0; d < 3; ++d)
    require(half_axes[d] >= smallest_half_axis && half_axes[d] <= largest_half_axis, "superquadric half-axis",
            half_axes[d], "positive, in [1e-30, 1e30] m; are its units metres?");
  const double ratio = half_axes.maxCoeff() / half_axes.minCoeff();
  require(ratio <= largest_ratio, "ratio of the superquadric's half-axes", ratio,
          "at most 1e5; make a longer body of several");
  for (const double eps : {eps1, eps2})
    require(eps >= smallest_exponent && eps <= largest_exponent, "superquadric exponent", eps,
            "in (0, 2), 1e-6 at least from both ends; 1 is an ellipsoid, 0.1 nearly a box");
}

bool Superquadric::is_sphere() const
{
  return eps1 == 1. && eps2 == 1. && half_axes[0] == half_axes[1] && half_axes[1] == half_axes[2];
}

double inside_outside(const Superquadric &shape, const Vec3 &body_point)
{
  const Vec3 x = body_point.cwiseQuotient(shape.half_axes).cwiseAbs();
  const double plane =
      std::pow(std::pow(x[0], 2. / shape.eps1) + std::pow(x[1], 2. / shape.eps1), shape.eps1 / shape.eps2);
  return plane + std::pow(x[2], 2. / shape.eps2);
}

double volume(const Superquadric &shape)
{
  const double e1 = shape.eps1, e2 = shape.eps2;
  const double g11 = beta_integral(e1 / 2, e1 / 2);
  const double g12 = beta_integral(e2 / 2, e2 + 1);
  return shape.half_axes.prod() * e1 * e2 * g11 * g12;
}

Vec3 inertia_per_density(const Superquadric &shape)
{
  if (shape.is_sphere()) // exactly alike in all directions
    return Vec3::Constant(8. / 15. * std::numbers::pi * std::pow(shape.half_axes[0], 5));
  const double e1 = shape.eps1, e2 = shape.eps2;
  const double g11 = beta_integral(e1 / 2, e1 / 2);
  const double g21 = beta_integral(e1 / 2, 3 * e1 / 2);
  const double g22 = beta_integral(e2 / 2, 2 * e2 + 1);
  const double g32 = beta_integral(3 * e2 / 2, e2 + 1);
  const Vec3 r2 = shape.half_axes.cwiseAbs2();
  const double factor = 0.5 * shape.half_axes.prod() * e1 * e2;
  return factor * Vec3(r2[1] * g21 * g22 + 2 * r2[2] * g11 * g32, r2[0] * g21 * g22 + 2 * r2[2] * g11 * g32,
                       (r2[0] + r2[1]) * g21 * g22);
}

double bounding_radius(const Superquadric &shape)
{
  const double plane_radius = largest_plane_radius(shape.half_axes[0], shape.half_axes[1], shape.eps1);
  return largest_plane_radius(plane_radius, shape.half_axes[2], shape.eps2);
}

double largest_swing(const Superquadric &shape)
{
  // The support height is the norm of (r1 n1, r2 n2, r3 n3) of dual exponents: least for an octahedron.
  const auto share = [](const double exponent) { return exponent > 1. ? std::sqrt(0.5) : 1.; };
  const double radius = bounding_radius(shape),
               height = share(shape.eps1) * share(shape.eps2) * shape.half_axes.minCoeff();
  return std::sqrt(std::max(radius * radius - height * height, 0.));
}

double equivalent_radius(const Superquadric &shape)
{
  return equivalent_radius(volume(shape));
}

double equivalent_radius(const double volume)
{
  return std::cbrt(volume * 3. / (4. * std::numbers::pi));
}

Vec3 surface_point(const Superquadric &shape, const double latitude, const double longitude)
{
  const double c = signed_power(std::cos(latitude), shape.eps2);
  return shape.half_axes.cwiseProduct(Vec3(c * signed_power(std::cos(longitude), shape.eps1),
                                           c * signed_power(std::sin(longitude), shape.eps1),
                                           signed_power(std::sin(latitude), shape.eps2)));
}

} // namespace bergamo::dem
