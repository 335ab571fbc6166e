#include "dem/core/tangent_frame.h"
#include "dem/geometry/contact_geometry.h"
#include "dem/geometry/superquadric.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>

using namespace bergamo;
using namespace bergamo::dem;

namespace
{

constexpr double pi = std::numbers::pi;

Support<double> support_of(const Superquadric &s, const Vec3 &n)
{
  return support(support_shape(s), n[0], n[1], n[2]);
}

Vec3 gradient(const Support<double> &s)
{
  return {s.x1, s.x2, s.x3};
}

Mat3 hessian(const Support<double> &s)
{
  Mat3 h;
  h << s.h11, s.h12, s.h13, s.h12, s.h22, s.h23, s.h13, s.h23, s.h33;
  return h;
}

struct RandomBodies
{
  std::mt19937_64 generator;
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> axis{0.5, 3.}, exponent{0.05, 1.95};

  explicit RandomBodies(const int seed) : generator(seed) {}

  Superquadric body()
  {
    return {{axis(generator), axis(generator), axis(generator)}, exponent(generator), exponent(generator)};
  }
  Vec3 direction() { return Vec3(normal(generator), normal(generator), normal(generator)).normalized(); }
};

/// (1/(2h))(f(h) - f(-h)) refined to sixth order.
template <class F>
auto central_difference(F &&f, const double h)
{
  const auto d = [&](const double s) { return ((f(s) - f(-s)) / (2. * s)).eval(); };
  return ((64. * d(h) - 20. * d(2. * h) + d(4. * h)) / 45.).eval();
}

} // namespace

TEST_CASE("the support height is the largest N.X of the surface, and X takes it")
{
  // X lies on the surface: F(X) = 1 with the rounding of its coordinates (1e-15) magnified by 2/eps. N.X = h, so the
  // largest height is h at least; and no sampled point goes higher, so it is h at most.
  RandomBodies random(1);
  for (int i = 0; i < 300; ++i)
  {
    const Superquadric body = random.body();
    const Vec3 n = random.direction();
    const Support<double> s = support_of(body, n);
    CAPTURE(body.half_axes.transpose(), body.eps1, body.eps2, n.transpose());
    CHECK(std::abs(gradient(s).dot(n) - s.h) <= 1e-14 * s.h);
    CHECK(std::abs(inside_outside(body, gradient(s)) - 1.) <= 1e-13 * 2. / std::min({body.eps1, body.eps2, 1.}));

    const auto height = [&](const double u, const double v) { return surface_point(body, u, v).dot(n); };
    double best = -s.h;
    constexpr int m = 100;
    for (int j = -m; j <= m; ++j)
      for (int k = -m; k <= m; ++k)
        best = std::max(best, height(0.5 * pi * j / m, pi * k / m));
    CHECK(best <= s.h * (1. + 1e-14));
  }
}

TEST_CASE("gradient and Hessian are the derivatives of height and gradient")
{
  // Central differences of sixth order, taken where all components are well away from zero compared with the step
  // (|N_i| > 0.02, step 2e-4 |N_i|-wide): truncation (h/|N_i|)^6 ~ 1e-12 times powers of q <= 40, rounding 1e-16/1e-4.
  RandomBodies random(2);
  int n_tested = 0;
  double worst_gradient = 0., worst_hessian = 0.;
  while (n_tested < 2000)
  {
    const Superquadric body = random.body();
    const Vec3 n = random.direction();
    if (n.cwiseAbs().minCoeff() < 0.02)
      continue;
    ++n_tested;
    const Support<double> s = support_of(body, n);
    const double q = std::max({2. / (2. - body.eps1), 2. / (2. - body.eps2), 1.});
    Vec3 g;
    Mat3 h;
    for (int d = 0; d < 3; ++d)
    {
      const double step = 4e-3 * std::abs(n[d]) / q;
      g[d] = central_difference([&](const double x)
                                { return Eigen::Matrix<double, 1, 1>(support_of(body, n + x * Vec3::Unit(d)).h); },
                                step)[0];
      h.col(d) =
          central_difference([&](const double x) { return gradient(support_of(body, n + x * Vec3::Unit(d))); }, step);
    }
    worst_gradient = std::max(worst_gradient, (g - gradient(s)).norm() / gradient(s).norm());
    worst_hessian =
        std::max(worst_hessian, (h - hessian(s)).norm() / std::max(hessian(s).norm(), body.half_axes.minCoeff()));
  }
  CHECK(worst_gradient < 1e-9);
  CHECK(worst_hessian < 1e-9);
}

TEST_CASE("H N = 0 and the tangential part is positive semidefinite")
{
  // X is homogeneous of degree 0, so its derivative along N vanishes (Euler); h is convex, so no eigenvalue is
  // negative.
  RandomBodies random(4);
  for (int i = 0; i < 5000; ++i)
  {
    const Superquadric body = random.body();
    const Vec3 n = random.direction();
    const Mat3 h = hessian(support_of(body, n));
    CAPTURE(body.eps1, body.eps2, n.transpose());
    const double scale = (h.cwiseAbs() * n.cwiseAbs()).maxCoeff(); // of the terms that cancel
    CHECK((h * n).norm() <= 1e-13 * scale + 1e-13);
    const auto frame = tangent_frame(n);
    const Eigen::Matrix2d t = frame.transpose() * h * frame;
    // Terms of the size X_i/N_j times q cancel in the entries: rounding 1e-16 of those shifts the eigenvalues.
    const double q = std::max(2. / (2. - body.eps1), 2. / (2. - body.eps2));
    const double terms = gradient(support_of(body, n)).cwiseAbs().maxCoeff() / n.cwiseAbs().minCoeff() * q;
    CHECK(0.5 * (t.trace() - std::hypot(t(0, 0) - t(1, 1), 2. * t(0, 1))) >= -1e-14 * terms);
  }
}

TEST_CASE("the support of a sphere and of an ellipsoid in closed form")
{
  // Sphere: h = r, X = r N, H = r (I - N N^T). Ellipsoid: h = |R N|, X = R^2 N / h, H = (R^2 - X X^T)/h, R = diag(r).
  RandomBodies random(6);
  for (int i = 0; i < 1000; ++i)
  {
    const Vec3 n = random.direction();
    const double r = 0.7;
    const Support<double> s = support_of({Vec3::Constant(r), 1., 1.}, n);
    CHECK(std::abs(s.h - r) < 1e-15 * 4.);
    CHECK((gradient(s) - r * n).norm() < 4e-15);
    CHECK((hessian(s) - r * (Mat3::Identity() - n * n.transpose())).norm() < 1e-14);

    const Vec3 axes(0.5, 1.9, 1.2), scaled = axes.cwiseProduct(n);
    const Support<double> e = support_of({axes, 1., 1.}, n);
    const double height = scaled.norm();
    const Vec3 x = axes.cwiseProduct(scaled) / height;
    const Mat3 h = (Mat3(axes.cwiseAbs2().asDiagonal()) - x * x.transpose()) / height;
    CHECK(std::abs(e.h - height) < 1e-14);
    CHECK((gradient(e) - x).norm() < 1e-14);
    CHECK((hessian(e) - h).norm() < 3e-14);
  }
}

TEST_CASE("the support is homogeneous: h of degree 1, X of degree 0, H of degree -1")
{
  RandomBodies random(7);
  for (int i = 0; i < 1000; ++i)
  {
    const Superquadric body = random.body();
    const Vec3 n = random.direction();
    const Support<double> one = support_of(body, n);
    for (const double factor : {1e-6, 0.3, 7., 1e6})
    {
      // log N changes by log 1e6 = 14 beside a few units: some rounding units, times q <= 40 in the exponent.
      const Support<double> scaled = support_of(body, factor * n);
      CHECK(std::abs(scaled.h - factor * one.h) <= 1e-13 * factor * one.h);
      CHECK((gradient(scaled) - gradient(one)).norm() <= 1e-12 * one.h);
      CHECK((factor * hessian(scaled) - hessian(one)).norm() <= 1e-12 * hessian(one).norm() + 1e-12);
    }
  }
}

TEST_CASE("the support height is convex")
{
  // h(a + b) <= h(a) + h(b) for every pair of directions.
  RandomBodies random(8);
  for (int i = 0; i < 5000; ++i)
  {
    const Superquadric body = random.body();
    const Vec3 a = random.direction(), b = random.direction();
    const double sum = support_of(body, a).h + support_of(body, b).h;
    CHECK(support_of(body, a + b).h <= sum * (1. + 1e-14));
  }
}

TEST_CASE("normals with components that are exactly zero, or tiny, give finite and consistent results")
{
  // With N_i = 0 the body's symmetry gives X_i = 0; along an axis h is the half-axis itself. Mirrored normals give
  // mirrored points to the last bit. Eigen's products of two Hessian entries must not overflow.
  for (const double eps1 : {0.05, 0.3, 0.999, 1., 1.3, 1.95})
    for (const double eps2 : {0.05, 0.3, 1., 1.0001, 1.7, 1.95})
    {
      const Superquadric body{{0.5, 1.9, 1.2}, eps1, eps2};
      CAPTURE(eps1, eps2);
      for (const double u : {0., 1e-300, 1e-120, 1e-30, 1e-12, 1.})
        for (const double v : {0., 1e-300, 1e-60, 1e-9, 1.})
          for (int axis = 0; axis < 3; ++axis)
          {
            Vec3 n;
            n[axis] = 1.;
            n[(axis + 1) % 3] = u;
            n[(axis + 2) % 3] = -v;
            n.normalize();
            const Support<double> s = support_of(body, n);
            const Mat3 h = hessian(s);
            CAPTURE(n.transpose());
            CHECK(std::isfinite(s.h));
            CHECK(gradient(s).allFinite());
            CHECK((h * h).allFinite());
            CHECK(std::abs(gradient(s).dot(n) - s.h) <= 1e-13 * s.h);
            for (int d = 0; d < 3; ++d)
            {
              CHECK(std::abs(gradient(s)[d]) <= body.half_axes[d] * (1. + 1e-12));
              if (n[d] == 0.)
                CHECK(gradient(s)[d] == 0.);
            }
            const Support<double> mirrored = support_of(body, -n);
            CHECK(mirrored.h == s.h);
            CHECK(gradient(mirrored) == -gradient(s));
            CHECK(hessian(mirrored) == h);
          }
      for (int axis = 0; axis < 3; ++axis)
      {
        const Support<double> s = support_of(body, Vec3::Unit(axis));
        CHECK(std::abs(s.h - body.half_axes[axis]) < 1e-14);
        CHECK((gradient(s) - body.half_axes[axis] * Vec3::Unit(axis)).norm() < 1e-13);
      }
    }
}

TEST_CASE("the support of a placed body turns with it")
{
  // arm(R n) = R X(n), Hessian R H R^T, seen in the tangent frame: three rotations of a vector, a few rounding units.
  RandomBodies random(9);
  for (int i = 0; i < 200; ++i)
  {
    const Superquadric body = random.body();
    const Quaternion turn = Quaternion(Eigen::Vector4d::Random()).normalized();
    const Mat3 r = turn.toRotationMatrix();
    const BodyPose pose = make_pose(body, random.direction(), turn);
    const Vec3 n = random.direction();
    const Support<double> s = support_of(body, r.transpose() * n);
    const TangentFrame frame = tangent_frame(n);
    const PlacedSupport<double> g = support(pose, n, frame);
    CHECK(std::abs(g.height - s.h) <= 1e-15 * s.h);
    CHECK((g.arm - r * gradient(s)).norm() <= 1e-14 * s.h);
    const Eigen::Matrix2d radii = frame.transpose() * r * hessian(s) * r.transpose() * frame;
    // The direction in the body is right to an epsilon or two, and a radius goes with powers of its components of up to
    // q = 2 / (2 - eps), which magnify that as much.
    const double least = (r.transpose() * n).cwiseAbs().minCoeff(), power = 2. / (2. - std::max(body.eps1, body.eps2));
    // At a tip the entries are small differences of terms of the size of h over the components.
    const double bound = power * ((1e-13 + 1e-14 / least) * hessian(s).norm() + 1e-15 * s.h / least);
    CHECK(std::abs(g.radii.r11 - radii(0, 0)) <= bound);
    CHECK(std::abs(g.radii.r22 - radii(1, 1)) <= bound);
    CHECK(std::abs(g.radii.r12 - radii(0, 1)) <= bound);
  }
}
