#include "dem/core/pack_vectors.h"
#include "dem/core/tangent_frame.h"
#include "dem/law/hertz.h"
#include "dem/state/material.h"

#include <algorithm>
#include <boost/math/special_functions/ellint_1.hpp>
#include <boost/math/special_functions/ellint_2.hpp>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>
#include <vector>

using namespace bergamo;
using namespace bergamo::dem;

namespace
{

constexpr double pi = std::numbers::pi;

/// Complete elliptic integrals by the arithmetic-geometric mean, from the ratio kappa of the ellipse's axes itself:
/// nothing cancels for circles or for needles. (Abramowitz & Stegun 17.6)
struct Integrals
{
  double k, e, d, b; ///< K, E, D = (K-E)/e^2, B = (E-(1-e^2)K)/e^2

  explicit Integrals(const double kappa)
  {
    const double e2 = (kappa - 1.) * (kappa + 1.) / (kappa * kappa);
    double a = 1., g = 1. / kappa, c2 = e2, power = 0.5, sum = 0.5 * e2; // sum of 2^(n-1) c_n^2
    double sum_over_e2 = 0.5;
    double c2_over_e2 = 1.;
    for (int n = 0; n < 60 && c2 > 0.; ++n)
    {
      const double next = 0.5 * (a + g);
      g = std::sqrt(a * g);
      a = next;
      const double factor = c2 / (16. * a * a); // c_{n+1} = c_n^2 / (4 a_{n+1})
      c2 *= factor;
      c2_over_e2 *= factor;
      power *= 2.;
      sum += power * c2;
      sum_over_e2 += power * c2_over_e2;
      if (c2 < 1e-40)
        break;
    }
    k = pi / (a + g);
    d = k * sum_over_e2;
    b = k - d;
    e = b + d / (kappa * kappa);
  }

  double curvature_ratio(const double kappa) const { return kappa * kappa * b / d; }
};

double axis_ratio(const double curvature_ratio)
{
  double low = 0., high = std::log(curvature_ratio) + 1e-9;
  for (int i = 0; i < 200; ++i)
  {
    const double middle = 0.5 * (low + high), kappa = std::exp(middle);
    (Integrals(kappa).curvature_ratio(kappa) < curvature_ratio ? low : high) = middle;
  }
  return std::exp(0.5 * (low + high));
}

/// Wellmann (3.19), (3.21), (3.22), (3.23) for delta = 1, from K and E directly.
HertzMindlin<double> direct(const double a, const double b, const double kappa, const double k, const double e,
                            const double d, const double bm, const ElasticPair &pair)
{
  const double semi_axis = std::sqrt(d / (a * k));
  return {2. / 3. * pi * kappa * std::sqrt(e / (k * k * k * (a + b))) * pair.effective_modulus,
          pi * semi_axis / (k * pair.lambda1 - bm * pair.lambda2),
          pi * semi_axis / (k * pair.lambda1 - d * pair.lambda2)};
}

double relative(const double value, const double expected)
{
  return std::abs(value / expected - 1.);
}

/// d p / d n of an ellipsoid's surface at the end of half-axis z turned into the direction z: radii x^2/z and y^2/z.
Mat3 tip_hessian(const double x, const double y, const double z, const double angle)
{
  const Mat3 turn = Eigen::AngleAxisd(angle, Vec3::UnitZ()).toRotationMatrix();
  return turn * Vec3(x * x / z, y * y / z, 0.).asDiagonal() * turn.transpose();
}

constexpr CurvatureBounds<double> wide{1e-12, 1e12};

/// The tangential part of d p / d n in the frame that the law expects.
CurvatureRadii<double> in_frame(const Vec3 &normal, const Mat3 &hessian)
{
  const TangentFrame frame = tangent_frame(normal);
  const Eigen::Matrix2d radii = frame.transpose() * hessian * frame;
  return {radii(0, 0), radii(1, 1), radii(0, 1)};
}

RelativeCurvature<double> curvature_at(const Vec3 &normal, const Mat3 &hessian1, const CurvatureBounds<double> &bounds1,
                                       const Mat3 &hessian2, const CurvatureBounds<double> &bounds2)
{
  return relative_curvature(tangent_frame(normal), PrincipalRadii(in_frame(normal, hessian1)), bounds1,
                            PrincipalRadii(in_frame(normal, hessian2)), bounds2);
}

/// Against a plane.
RelativeCurvature<double> curvature_at(const Vec3 &normal, const Mat3 &hessian, const CurvatureBounds<double> &bounds)
{
  return relative_curvature(tangent_frame(normal), PrincipalRadii(in_frame(normal, hessian)), bounds);
}

const Material soft{60e9, 0.3, 2650.}, hard{200e9, 0.15, 7800.};

} // namespace

TEST_CASE("the reference integrals agree with libraries where those are accurate")
{
  // Functions of the modulus e lose a digit for each in 1 - e^2 = 1/kappa^2: 1e-13 for kappa <= 30. Boost's E is good
  // to rounding; libstdc++'s stops its series at about 1e-12.
  for (double kappa = 1.2; kappa <= 30.; kappa *= 1.3)
  {
    const Integrals i(kappa);
    const double e2 = 1. - 1. / (kappa * kappa), modulus = std::sqrt(e2);
    const double k = boost::math::ellint_1(modulus), e = boost::math::ellint_2(modulus);
    CHECK(relative(i.k, std::comp_ellint_1(modulus)) < 1e-13);
    CHECK(relative(i.e, std::comp_ellint_2(modulus)) < 1e-12);
    CHECK(relative(i.k, k) < 1e-13);
    CHECK(relative(i.e, e) < 1e-13);
    CHECK(relative(i.d, (k - e) / e2) < 1e-12);
    CHECK(relative(i.b, (e - (1. - e2) * k) / e2) < 1e-12);
    CHECK(relative(i.curvature_ratio(kappa), (kappa * kappa * e - k) / (k - e)) < 1e-12);
  }
}

TEST_CASE("the table gives the force and the stiffnesses of the elliptic integrals")
{
  // The documented bound: 1e-8 for the normal force, 1e-7 for the tangential stiffness, over b/a in [1, 1e10]. The
  // table's cubic interpolation with steps of 0.011 in log(b/a) errs by (3/128) 0.011^4 f'''' = 4e-10 f''''.
  const ElasticPair pair = elastic_pair(soft, hard);
  double worst_normal = 0., worst_major = 0., worst_minor = 0., worst_standard = 0.;
  std::mt19937_64 generator(1);
  std::uniform_real_distribution<double> log_ratio(0., std::log(1e10)), small(0., 0.1), scale(-12., 12.);
  for (int i = 0; i < 6000; ++i)
  {
    const double ratio = i == 0   ? 1. + 1e-12
                         : i == 1 ? 1e10 * (1. - 1e-12)
                                  : std::exp(i % 4 ? log_ratio(generator) : small(generator));
    const double a = std::exp(scale(generator)), b = a * ratio;
    const double kappa = axis_ratio(ratio);
    const Integrals s(kappa);
    const HertzMindlin<double> expected = direct(a, b, kappa, s.k, s.e, s.d, s.b, pair),
                               found = hertz_mindlin(a, b, pair);
    worst_normal = std::max(worst_normal, relative(found.normal, expected.normal));
    worst_major = std::max(worst_major, relative(found.tangential_major, expected.tangential_major));
    worst_minor = std::max(worst_minor, relative(found.tangential_minor, expected.tangential_minor));
    if (kappa > 1.1 && kappa < 30.)
    {
      const double e2 = 1. - 1. / (kappa * kappa), k = std::comp_ellint_1(std::sqrt(e2)),
                   e = std::comp_ellint_2(std::sqrt(e2));
      const HertzMindlin<double> standard = direct(a, b, kappa, k, e, (k - e) / e2, (e - (1. - e2) * k) / e2, pair);
      worst_standard = std::max({worst_standard, relative(found.normal, standard.normal),
                                 relative(found.tangential_major, standard.tangential_major)});
    }
  }
  CAPTURE(worst_normal, worst_major, worst_minor, worst_standard);
  CHECK(worst_normal < 1e-8);
  CHECK(worst_major < 1e-7);
  CHECK(worst_minor < 1e-7);
  CHECK(worst_standard < 1e-8);

  // Beyond the table the last entry holds: the dependence on the ratio stops, the one on a + b goes on.
  const HertzMindlin<double> last = hertz_mindlin(1., 1e10, pair), beyond = hertz_mindlin(1., 1e12, pair);
  CHECK(relative(beyond.normal * std::sqrt(1. + 1e12), last.normal * std::sqrt(1. + 1e10)) < 1e-14);
}

TEST_CASE("two spheres, and a sphere on a plane")
{
  // gamma = (4/3) sqrt(R*), tangential stiffness 4 G a/(2 - nu) with a = sqrt(R* delta): the circle is a node of the
  // table, so only the rounding of the table's own solution remains.
  for (const double nu : {0., 0.2, 0.45})
  {
    const Material grain{50e9, nu, 2650.};
    const ElasticPair pair = elastic_pair(grain, grain);
    CHECK(relative(pair.effective_modulus, 50e9 / (2. * (1. - nu * nu))) < 1e-15);
    const double shear_modulus = 50e9 / (2. * (1. + nu));
    for (const auto &[r1, r2] : {std::pair(1e-3, 1e-3), std::pair(1e-3, 2e-2), std::pair(3., 0.7)})
    {
      const Vec3 n = Vec3(0.3, -0.5, 0.9).normalized();
      const Mat3 tangential = Mat3::Identity() - n * n.transpose();
      const auto check_sphere = [&](const RelativeCurvature<double> &c, const double radius)
      {
        // R* of two spheres: 1/R* = 1/r1 + 1/r2 and A = B = 1/(2 R*).
        CHECK(relative(c.a, 0.5 / radius) < 1e-12);
        CHECK(relative(c.b, 0.5 / radius) < 1e-12);
        CHECK(std::abs(c.major_axis.norm() - 1.) < 1e-14);
        CHECK(std::abs(c.major_axis.dot(n)) < 1e-14);
        const HertzMindlin<double> law = hertz_mindlin(c.a, c.b, pair);
        CHECK(relative(law.normal, 4. / 3. * std::sqrt(radius) * pair.effective_modulus) < 1e-11);
        const double stiffness = 4. * shear_modulus * std::sqrt(radius) / (2. - nu);
        CHECK(relative(law.tangential_major, stiffness) < 1e-11);
        CHECK(relative(law.tangential_minor, stiffness) < 1e-11);
      };
      check_sphere(curvature_at(n, r1 * tangential, wide, r2 * tangential, wide), r1 * r2 / (r1 + r2));
      check_sphere(curvature_at(n, r1 * tangential, wide), r1);
    }
  }
  // Unlike materials: 1/C = 4 a / ((2 - nu1)/G1 + (2 - nu2)/G2)) * 2 (Mindlin 1949): 8 a / ((2-nu1)/G1 + (2-nu2)/G2).
  const double g1 = soft.young_modulus / (2. * 1.3), g2 = hard.young_modulus / (2. * 1.15);
  const HertzMindlin<double> law = hertz_mindlin(0.5, 0.5, elastic_pair(soft, hard)); // R* = 1
  CHECK(relative(law.tangential_major, 8. / (1.7 / g1 + 1.85 / g2)) < 1e-11);
}

TEST_CASE("relative curvature of crossed ellipsoids in closed form")
{
  // Principal curvatures k1 (along x) and k2 of both, turned by w: A + B = (sum of all)/2 and
  // (B - A)^2 = (D1^2 + D2^2 + 2 D1 D2 cos 2w)/4 with D = k1 - k2 (Hertz 1881; Wellmann 3.15, 3.16).
  const double x1 = 2., y1 = 0.5, z1 = 1., x2 = 0.7, y2 = 1.5, z2 = 1.2;
  const double k1x = z1 / (x1 * x1), k1y = z1 / (y1 * y1), k2x = z2 / (x2 * x2), k2y = z2 / (y2 * y2);
  for (double angle = -3.; angle < 3.2; angle += 0.17)
  {
    const RelativeCurvature<double> c =
        curvature_at(Vec3::UnitZ(), tip_hessian(x1, y1, z1, 0.4), wide, tip_hessian(x2, y2, z2, 0.4 + angle), wide);
    const double d1 = k1x - k1y, d2 = k2x - k2y;
    const double sum = 0.5 * (k1x + k1y + k2x + k2y);
    const double difference = 0.5 * std::sqrt(d1 * d1 + d2 * d2 + 2. * d1 * d2 * std::cos(2. * angle));
    CHECK(relative(c.a + c.b, sum) < 1e-13);
    CHECK(std::abs(c.b - c.a - difference) < 1e-13 * sum);
    // The axis of least curvature: v.(S v) = 2 a with S the sum of both curvature tensors.
    const auto curvature = [&](const double kx, const double ky, const double turn) -> Mat3
    {
      const Mat3 r = Eigen::AngleAxisd(turn, Vec3::UnitZ()).toRotationMatrix();
      return r * Vec3(kx, ky, 0.).asDiagonal() * r.transpose();
    };
    const Mat3 s = curvature(k1x, k1y, 0.4) + curvature(k2x, k2y, 0.4 + angle);
    CHECK(std::abs(c.major_axis.dot(s * c.major_axis) - 2. * c.a) < 1e-12 * sum);
    CHECK(std::abs(c.major_axis[2]) < 1e-15);
  }
  // Two long rods, crossed at right angles: circular contact; parallel: a line, b/a = ratio of the curvatures.
  const RelativeCurvature<double> crossed =
      curvature_at(Vec3::UnitZ(), tip_hessian(10., 1., 1., 0.), wide, tip_hessian(10., 1., 1., 0.5 * pi), wide);
  CHECK(relative(crossed.b, crossed.a) < 1e-14);
  CHECK(relative(crossed.a, 0.5 * (1. + 0.01)) < 1e-14);
  const RelativeCurvature<double> parallel =
      curvature_at(Vec3::UnitZ(), tip_hessian(10., 1., 1., 0.), wide, tip_hessian(10., 1., 1., 0.), wide);
  CHECK(relative(parallel.a, 0.01) < 1e-13);
  CHECK(relative(parallel.b, 1.) < 1e-13);
  CHECK(std::abs(std::abs(parallel.major_axis[0]) - 1.) < 1e-14);
}

TEST_CASE("relative curvature does not depend on the frame or on the order of the pair")
{
  // The sum of two matrices commutes; turning everything turns the major axis: rounding of some products.
  std::mt19937_64 generator(4);
  std::uniform_real_distribution<double> axis(0.2, 3.), angle(-3., 3.);
  for (int i = 0; i < 500; ++i)
  {
    const Mat3 h1 = tip_hessian(axis(generator), axis(generator), axis(generator), angle(generator));
    const Mat3 h2 = tip_hessian(axis(generator), axis(generator), axis(generator), angle(generator));
    const RelativeCurvature<double> one = curvature_at(Vec3::UnitZ(), h1, wide, h2, wide);
    const RelativeCurvature<double> other = curvature_at(-Vec3::UnitZ(), h2, wide, h1, wide);
    CHECK(relative(other.a, one.a) < 1e-12);
    CHECK(relative(other.b, one.b) < 1e-12);
    CHECK(relative(curvature_at(Vec3::UnitZ(), h2, wide, h1, wide).a, one.a) <
          1e-14); // fused operations do not commute
    if (one.b > 1.001 * one.a)
      CHECK(std::abs(std::abs(other.major_axis.dot(one.major_axis)) - 1.) < 1e-9);

    const Mat3 turn = Quaternion(Eigen::Vector4d::Random()).normalized().toRotationMatrix();
    const RelativeCurvature<double> turned =
        curvature_at(turn.col(2), turn * h1 * turn.transpose(), wide, turn * h2 * turn.transpose(), wide);
    CHECK(relative(turned.a, one.a) < 1e-11);
    CHECK(relative(turned.b, one.b) < 1e-11);
    if (one.b > 1.001 * one.a)
      CHECK(std::abs(std::abs(turned.major_axis.dot(turn * one.major_axis)) - 1.) < 1e-9);

    const ElasticPair forth = elastic_pair(soft, hard), back = elastic_pair(hard, soft);
    CHECK(relative(forth.effective_modulus, back.effective_modulus) < 1e-15);
    CHECK(hertz_mindlin(one.a, one.b, forth).normal == Approx(hertz_mindlin(one.a, one.b, back).normal).epsilon(1e-14));
  }
}

TEST_CASE("radii of curvature are kept within their bounds")
{
  // Flat (radius 1e9) and sharp (radius 1e-9) spots take the bounds; the directions stay. Half the curvatures 1/r add.
  const CurvatureBounds<double> bounds{0.1, 20.};
  const Mat3 mixed = Vec3(1e9, 1e-9, 0.).asDiagonal();
  const RelativeCurvature<double> on_plane = curvature_at(Vec3::UnitZ(), mixed, bounds);
  CHECK(relative(on_plane.a, 0.5 / 20.) < 1e-12);
  CHECK(relative(on_plane.b, 0.5 / 0.1) < 1e-12);
  CHECK(std::abs(std::abs(on_plane.major_axis[0]) - 1.) < 1e-14);

  const RelativeCurvature<double> flat =
      curvature_at(Vec3::UnitZ(), Vec3(1e95, 1e95, 0.).asDiagonal(), bounds, Vec3(0., 0., 0.).asDiagonal(), bounds);
  CHECK(relative(flat.a, 0.5 * (1. / 20. + 1. / 0.1)) < 1e-12);
  CHECK(relative(flat.b, flat.a) < 1e-12);

  // Within the bounds nothing changes.
  const Mat3 usual = Vec3(0.5, 7., 0.).asDiagonal();
  CHECK(relative(curvature_at(Vec3::UnitZ(), usual, bounds).a, 0.5 / 7.) < 1e-13);
  CHECK(relative(curvature_at(Vec3::UnitZ(), usual, bounds).b, 0.5 / 0.5) < 1e-13);
}

TEST_CASE("the table against the standard library's integrals over the range where those are accurate")
{
  // From e = sqrt(1 - 1/kappa^2) the integrals lose a digit of 1/kappa^2 each: 1e-10 at kappa = 1000. K - E and B lose
  // e^2 of libstdc++'s 1e-12: 1e-9 at kappa = 1.001.
  double worst_force = 0., worst_axis = 0., worst_compliance = 0.;
  for (double kappa = 1.001; kappa < 1000.; kappa *= 1.003)
  {
    const double e2 = (kappa - 1.) * (kappa + 1.) / (kappa * kappa), modulus = std::sqrt(e2);
    const double k = std::comp_ellint_1(modulus), e = std::comp_ellint_2(modulus);
    const double d = (k - e) / e2, b = (e - (1. - e2) * k) / e2;
    const double log_ratio = std::log(kappa * kappa * b / d);
    const EllipseShape<double> shape = ellipse_table()(log_ratio);
    worst_force = std::max(worst_force, relative(shape.force, kappa * std::sqrt(e / (k * k * k))));
    worst_axis = std::max(worst_axis, relative(shape.semi_axis, std::sqrt(d * (1. + std::exp(log_ratio)) / k)));
    worst_compliance = std::max({worst_compliance, relative(shape.k, k), relative(shape.bm, b), relative(shape.d, d)});
  }
  CAPTURE(worst_force, worst_axis, worst_compliance);
  CHECK(worst_force < 1e-8);
  CHECK(worst_axis < 1e-8);
  CHECK(worst_compliance < 1e-8);
}

TEST_CASE("tangential over normal compliance of elliptic contacts")
{
  // Mindlin (1949), Deresiewicz (1957), equal bodies. Circle: (2 - nu) / (2 (1 - nu)). Without lateral contraction: 1
  // for every ellipse. Long ellipse: 1/(1 - nu) along it and 1 across it (plane strain), reached with the logarithm of
  // the axes' ratio: the rest is nu/(1 - nu) times B/K, and K - 1 < D < K, 0 < B <= 1. In between both rise and fall.
  for (const double nu : {0., 0.2, 0.35, 0.49})
  {
    const Material grain{50e9, nu, 2650.};
    const ElasticPair pair = elastic_pair(grain, grain);
    const auto ratios = [&](const double curvature_ratio)
    {
      const HertzMindlin<double> law = hertz_mindlin(1., curvature_ratio, pair);
      return std::pair(1.5 * law.normal / law.tangential_major, 1.5 * law.normal / law.tangential_minor);
    };
    const auto [circle_major, circle_minor] = ratios(1.);
    CHECK(relative(circle_major, (2. - nu) / (2. * (1. - nu))) < 1e-9);
    CHECK(relative(circle_minor, (2. - nu) / (2. * (1. - nu))) < 1e-9);
    double last_major = circle_major, last_minor = circle_minor;
    for (double ratio = 1.1; ratio < 0.9e10; ratio *= 1.7)
    {
      const auto [major, minor] = ratios(ratio);
      CAPTURE(nu, ratio);
      // Normal and tangential coefficient are each good to 1e-8.
      if (nu == 0.)
      {
        CHECK(relative(major, 1.) < 5e-8);
        CHECK(relative(minor, 1.) < 5e-8);
        continue;
      }
      CHECK(major > last_major);
      CHECK(minor < last_minor);
      const Integrals i(axis_ratio(ratio));
      const double rest = nu / (1. - nu) * i.b / i.k;
      CHECK(std::abs(1. / (1. - nu) - major - rest) < 5e-8 / (1. - nu));
      CHECK(std::abs(minor - 1. - rest) < 5e-8 / (1. - nu));
      last_major = major;
      last_minor = minor;
    }
  }
}

TEST_CASE("the law in packs is the law of one contact")
{
  // Every lane its own contact; the vector library's logarithm differs by 1 ulp.
  std::mt19937_64 generator(8);
  std::uniform_real_distribution<double> log_radius(-3., 3.), angle(-3., 3.);
  const ElasticPair pair = elastic_pair(soft, hard);
  for (int i = 0; i < 200; ++i)
  {
    std::vector<CurvatureRadii<double>> radii1, radii2;
    std::vector<Vec3> normal;
    for (int k = 0; k < pack_width; ++k)
    {
      const auto random_radii = [&]() -> CurvatureRadii<double>
      {
        const double low = std::exp(log_radius(generator)), high = std::exp(log_radius(generator));
        const double c = std::cos(angle(generator)), s = std::sqrt(1. - c * c);
        return {low * c * c + high * s * s, low * s * s + high * c * c, (low - high) * c * s};
      };
      radii1.push_back(random_radii());
      radii2.push_back(random_radii());
      normal.push_back(Vec3(angle(generator), angle(generator), angle(generator)).normalized());
    }
    const auto gather = [](const std::vector<CurvatureRadii<double>> &radii) -> CurvatureRadii<Pack>
    {
      return {math::generate<Pack>([&](const int k) { return radii[k].r11; }),
              math::generate<Pack>([&](const int k) { return radii[k].r22; }),
              math::generate<Pack>([&](const int k) { return radii[k].r12; })};
    };
    const Vector3<Pack> normals = math::gather_vectors<Pack>([&](const int k) -> const Vec3 & { return normal[k]; });
    const CurvatureBounds<double> bounds{0.1, 5.};
    const CurvatureBounds<Pack> pack_bounds{Pack(0.1), Pack(5.)};
    const RelativeCurvature<Pack> packed =
        relative_curvature<Pack>(tangent_frame(normals), PrincipalRadii(gather(radii1)), pack_bounds,
                                 PrincipalRadii(gather(radii2)), pack_bounds);
    const HertzMindlin<Pack> laws = hertz_mindlin(packed.a, packed.b, pair);
    for (int k = 0; k < pack_width; ++k)
    {
      const RelativeCurvature<double> one = relative_curvature<double>(
          tangent_frame(normal[k]), PrincipalRadii(radii1[k]), bounds, PrincipalRadii(radii2[k]), bounds);
      const HertzMindlin<double> law = hertz_mindlin(one.a, one.b, pair);
      CHECK(relative(math::lane(packed.a, k), one.a) < 1e-12);
      CHECK(relative(math::lane(packed.b, k), one.b) < 1e-12);
      CHECK(relative(math::lane(laws.normal, k), law.normal) < 1e-12);
      CHECK(relative(math::lane(laws.tangential_major, k), law.tangential_major) < 1e-12);
      CHECK(relative(math::lane(laws.tangential_minor, k), law.tangential_minor) < 1e-12);
    }
  }
}

TEST_CASE("what the bounds of curvature do to a box-like grain on a plane")
{
  // A cube of half-axis 1, tilted: 0 the middle of a face, 45 degrees an edge. Printed: the Hertz coefficient over that
  // of the sphere of radius 1, (4/3) E*. In the middle of a face both radii take the bound 1/k: the coefficient is
  // 1/sqrt(k). Along an edge one radius is without bound at any tilt in this plane.
  const ElasticPair pair = elastic_pair(soft, hard);
  std::printf("Hertz coefficient of a cube on a plane over the sphere's\n  eps  tilt");
  const std::vector<double> factors{0.02, 0.05, 0.1, 0.2, 0.5};
  for (const double factor : factors)
    std::printf("   k=%.2f", factor);
  std::printf("\n");
  for (const double eps : {0.2, 0.3, 0.4})
    for (const double tilt : {0., 0.1, 1., 5., 20., 45.})
    {
      const BodyPose body = make_pose({Vec3::Ones(), eps, eps}, Vec3::Zero(), Quaternion::Identity());
      const Vec3 n(std::sin(tilt * pi / 180.), 0., std::cos(tilt * pi / 180.));
      const PrincipalRadii<double> radii = principal_radii<double>(body, n, support(body, n).radii);
      std::printf("%5.1f %5.1f", eps, tilt);
      std::vector<double> coefficients;
      for (const double factor : factors)
      {
        const auto c = relative_curvature(tangent_frame(n), radii, curvature_bounds(body.shape, factor));
        coefficients.push_back(hertz_mindlin(c.a, c.b, pair).normal / (4. / 3. * pair.effective_modulus));
        std::printf(" %8.3f", coefficients.back());
        if (tilt == 0.)
          CHECK(relative(coefficients.back(), 1. / std::sqrt(factor)) < 1e-8);
        // Bounds [k, 1/k]: between those of the two spheres.
        CHECK(coefficients.back() < 1.0001 / std::sqrt(factor));
        CHECK(coefficients.back() > 0.9999 * std::sqrt(factor));
      }
      std::printf("\n");
    }
}
