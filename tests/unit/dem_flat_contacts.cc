#include "dem/core/pack_vectors.h"
#include "dem/core/tangent_frame.h"
#include "dem/law/hertz.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

// The stiffness of contacts near the middle of a flat face, where radii of curvature go to infinity (or to zero: a
// point). Near the pole N = e3 the support height is h = r3 + c P^q2, with P = ((r1|N1|)^q1 + (r2|N2|)^q1)^(1/q1) a
// norm of the tilt, so radii grow like tilt^(q2 - 2). With both dual exponents below two (eps < 1) they go to infinity
// in every direction of the tilt, also along an axis of the body, where one of them is infinite at any tilt: bounded to
// r_max/k, both are r_max/k in the limit. With one exponent on either side of two the limit depends on the direction of
// the tilt; then what is asked for is that no step of the tilt changes much, the last one to zero included.

using namespace bergamo;
using namespace bergamo::dem;

namespace
{

constexpr double pi = std::numbers::pi;

const ElasticPair elastic = elastic_pair({50e9, 0.2, 2650.}, {50e9, 0.2, 2650.});
const Vec3 half_axes(0.5, 1.2, 0.8);

struct Face
{
  double eps1, eps2;
  int axis;         ///< of the body, across the face
  double turn;      ///< of the body about this axis: the tangent frame is not that of the body
  double direction; ///< of the tilt in the face

  template <class Real>
  Pose<Real> body() const
  {
    const Mat3 turned = Eigen::AngleAxisd(turn, Vec3::Unit(axis)).toRotationMatrix();
    Pose<Real> pose{{Real(half_axes[0]), Real(half_axes[1]), Real(half_axes[2]), Real(eps1), Real(eps2)}, {}, {}};
    for (int i = 0; i < 3; ++i)
    {
      pose.position[i] = Real(0.);
      for (int j = 0; j < 3; ++j)
        pose.rotation(i, j) = Real(i == axis || j == axis ? double(i == j) : turned(i, j)); // exact zeros
    }
    return pose;
  }

  Vec3 normal(const double tilt) const
  {
    Vec3 n;
    n[axis] = 1.;
    n[(axis + 1) % 3] = tilt * std::cos(direction);
    n[(axis + 2) % 3] = direction == 0.5 * pi ? tilt : tilt * std::sin(direction);
    if (direction == 0.5 * pi)
      n[(axis + 1) % 3] = 0.;
    return n.normalized();
  }
};

/// gamma E* of two equal grains, equally turned, for as many tilts as Real has lanes.
template <class Real>
Real coefficient(const Face &face, const double bound, const Vector3<Real> &n)
{
  const Pose<Real> body = face.body<Real>();
  const TangentFrameOf<Real> frame = tangent_frame(n);
  const CurvatureRadii<Real> radii1 = support<Real>(body, n, frame).radii,
                             radii2 = support<Real>(body, -n, frame).radii;
  const CurvatureBounds<Real> bounds = curvature_bounds(body.shape, bound);
  const RelativeCurvature<Real> c =
      relative_curvature(frame, principal_radii(body, n, radii1), bounds, principal_radii(body, n, radii2), bounds);
  return hertz_mindlin(c.a, c.b, elastic).normal;
}

double coefficient(const Face &face, const double bound, const double tilt)
{
  return coefficient<double>(face, bound, face.normal(tilt));
}

/// gamma E* of two spheres of this radius.
double sphere_coefficient(const double radius)
{
  return 4. / 3. * std::sqrt(0.5 * radius) * elastic.effective_modulus;
}

std::vector<Face> faces(const double eps1, const double eps2)
{
  std::vector<Face> all;
  for (int axis = 0; axis < 3; ++axis)
  {
    for (const double direction : {0., 1e-8, 0.1, 0.25 * pi, 1.2, 0.5 * pi})
      all.push_back({eps1, eps2, axis, 0., direction});
    for (const double direction : {0., 0.4, 1.2}) // never along an axis of the body: rounding would turn it
      all.push_back({eps1, eps2, axis, 1., direction});
  }
  return all;
}

/// 0 and 1e-300 to 1e-2, ten a decade.
std::vector<double> tilts()
{
  std::vector<double> all{0.};
  for (int i = -3000; i <= -20; ++i)
    all.push_back(std::pow(10., 0.1 * i));
  return all;
}

} // namespace

TEST_CASE("aligned flat faces have both radii at their bound, whatever small tilt there is")
{
  // Bounds of both radii: two spheres of radius r_max/k. Their true radii are tilt^(q - 2) times a length of the order
  // of the half-axes, q - 2 <= -0.35 for eps <= 0.8: above 1e6 r_max for tilts below 1e-20. The Hertz table is good for
  // 1e-8.
  for (const auto &[eps1, eps2] : {std::pair(0.3, 0.6), std::pair(0.6, 0.3), std::pair(0.6, 0.7), std::pair(0.7, 0.6),
                                   std::pair(0.05, 0.8), std::pair(0.8, 0.1), std::pair(0.5, 0.5)})
    for (const double bound : {1., 0.1, 1e-2, 1e-4})
    {
      double worst = 0., worst_tilt = 0.;
      const double limit = sphere_coefficient(half_axes.maxCoeff() / bound);
      for (const Face &face : faces(eps1, eps2))
        for (const double tilt : tilts())
        {
          if (tilt > 1e-20)
            break;
          const double error = std::abs(coefficient(face, bound, tilt) / limit - 1.);
          if (!(error <= worst))
          {
            worst = error;
            worst_tilt = tilt;
          }
        }
      CAPTURE(eps1, eps2, bound, worst_tilt);
      CHECK(worst < 1e-7);
    }
}

TEST_CASE("the stiffness changes continuously with the tilt of flat and of pointed faces")
{
  // From one tilt to the next, longer by 10^0.1, no entry of the curvature grows or falls by more than 10^(0.1 p), p
  // the largest of |q1 - 2|, |q2 - 2| and |q2 - q1|, since all are sums of such powers, bounded to one another; gamma
  // goes with the root of the radii. A radius is known to 1e-4 beside another one of 1e12 half-axes.
  for (const auto &[eps1, eps2] :
       {std::pair(0.3, 0.6), std::pair(0.6, 0.3), std::pair(0.6, 0.7), std::pair(0.9, 0.95), std::pair(1., 0.3),
        std::pair(0.3, 1.), std::pair(1., 1.), std::pair(1.3, 0.6), std::pair(0.6, 1.3), std::pair(1.4, 1.2)})
  {
    const double q1 = 2. / (2. - eps1), q2 = 2. / (2. - eps2);
    const double power = std::max({std::abs(q1 - 2.), std::abs(q2 - 2.), std::abs(q2 - q1)});
    for (const double bound : {1., 0.1, 1e-3, 1e-6})
    {
      double worst = 0., worst_tilt = 0., worst_axis = 0, worst_direction = 0.;
      for (const Face &face : faces(eps1, eps2))
      {
        double before = coefficient(face, bound, 0.);
        for (const double tilt : tilts())
        {
          const double now = coefficient(face, bound, tilt), change = std::abs(std::log(now / before));
          before = now;
          if (!(change <= worst))
          {
            worst = change;
            worst_tilt = tilt;
            worst_axis = face.axis;
            worst_direction = face.direction;
          }
        }
      }
      CAPTURE(eps1, eps2, bound, worst_tilt, worst_axis, worst_direction);
      CHECK(worst <= std::log(10.) * 0.1 * 0.5 * power + 1e-3);
    }
  }
}

TEST_CASE("packs give flat contacts the stiffness that single contacts have")
{
  // Every lane its own tilt; SLEEF's functions differ by some ulp, magnified by logarithms of 1e-100 and by q <= 2.9.
  const std::vector<double> all = tilts();
  for (const auto &[eps1, eps2] : {std::pair(0.3, 0.6), std::pair(0.6, 0.7), std::pair(1.3, 0.6), std::pair(0.6, 1.3)})
    for (const Face &face : faces(eps1, eps2))
    {
      double worst = 0.;
      for (std::size_t begin = 0; begin < all.size(); begin += 7)
      {
        std::vector<Vec3> normals;
        for (int k = 0; k < pack_width; ++k)
          normals.push_back(face.normal(all[std::min(begin + 20 * k, all.size() - 1)]));
        const Vector3<Pack> n = math::gather_vectors<Pack>([&](const int k) -> const Vec3 & { return normals[k]; });
        const Pack packed = coefficient<Pack>(face, 0.1, n);
        for (int k = 0; k < pack_width; ++k)
        {
          const double error = std::abs(math::lane(packed, k) / coefficient<double>(face, 0.1, normals[k]) - 1.);
          worst = error <= worst ? worst : error;
        }
      }
      CAPTURE(eps1, eps2, face.axis, face.turn, face.direction);
      CHECK(worst < 1e-11);
    }
}
