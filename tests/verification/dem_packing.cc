#include "dem/core/error.h"
#include "dem/geometry/common_normal.h"
#include "dem/loading/compression.h"
#include "dem/packing/grading.h"
#include "dem/packing/random_addition.h"
#include "dem/simulation/simulation.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <omp.h>
#include <random>
#include <vector>

using namespace bergamo;
using namespace bergamo::dem;

namespace
{

constexpr double pi = std::numbers::pi;

/// Mean and deviation of a normal distribution (mu, s) cut to [a, b].
struct CutNormal
{
  double mean, deviation;

  CutNormal(const double mu, const double s, const double a, const double b)
  {
    const auto density = [](const double x) { return std::exp(-0.5 * x * x) / std::sqrt(2. * pi); };
    const auto below = [](const double x) { return 0.5 * std::erfc(-x / std::sqrt(2.)); };
    const double l = (a - mu) / s, h = (b - mu) / s, z = below(h) - below(l);
    const double shift = (density(l) - density(h)) / z;
    mean = mu + s * shift;
    deviation = s * std::sqrt(1. + (l * density(l) - h * density(h)) / z - shift * shift);
  }
};

std::vector<double> pressed_positions(const Particles &p)
{
  std::vector<double> values;
  for (std::size_t i = 0; i < p.size(); ++i)
  {
    for (int d = 0; d < 3; ++d)
      values.push_back(p.position[i][d]);
    for (int d = 0; d < 4; ++d)
      values.push_back(p.orientation[i].coeffs()[d]);
  }
  return values;
}

} // namespace

TEST_CASE("half-axes and exponents follow their distributions")
{
  // Half-axes: a Gaussian cut to the bounds, whose mean and deviation are closed forms; exponents: uniform, mean 0.9,
  // deviation 0.6/sqrt(12). n draws scatter by deviation/sqrt(n) about the mean and, for these flat distributions, by
  // less than deviation/sqrt(n) about the deviation: five of them.
  const GrainDistribution sand;
  std::mt19937_64 generator(1);
  constexpr int n = 100000;
  Eigen::Matrix<double, 5, 1> sum = Eigen::Matrix<double, 5, 1>::Zero(), squares = sum;
  bool in_bounds = true;
  for (int i = 0; i < n; ++i)
  {
    const Superquadric g = draw_grain(sand, generator);
    Eigen::Matrix<double, 5, 1> v;
    v << g.half_axes, g.eps1, g.eps2;
    sum += v;
    squares += v.cwiseAbs2();
    in_bounds = in_bounds && g.half_axes.minCoeff() >= sand.smallest_half_axis &&
                g.half_axes.maxCoeff() <= sand.largest_half_axis && std::min(g.eps1, g.eps2) >= 0.6 &&
                std::max(g.eps1, g.eps2) <= 1.2;
  }
  CHECK(in_bounds);
  for (int d = 0; d < 5; ++d)
  {
    const double mean = sum[d] / n, deviation = std::sqrt(squares[d] / n - mean * mean);
    const double mu = d < 3 ? sand.mean_half_axes[d] : 0.9;
    const CutNormal cut(mu, 0.2 * mu, sand.smallest_half_axis, sand.largest_half_axis);
    const double expected_mean = d < 3 ? cut.mean : 0.9,
                 expected_deviation = d < 3 ? cut.deviation : 0.6 / std::sqrt(12.);
    CAPTURE(d);
    CHECK(std::abs(mean - expected_mean) < 5. * expected_deviation / std::sqrt(n));
    CHECK(std::abs(deviation - expected_deviation) < 5. * expected_deviation / std::sqrt(n));
  }
}

TEST_CASE("random orientations are uniform")
{
  // Uniform rotations turn any vector to a uniform direction: means 0, second moments 1/3, with deviations
  // 1/sqrt(3 n) and sqrt(4/45/n); the angle between two unit quaternions has <q_i q_j> = 1/4 on the diagonal.
  std::mt19937_64 generator(2);
  constexpr int n = 50000;
  Mat3 first = Mat3::Zero(), second = Mat3::Zero();
  Eigen::Matrix4d quaternions = Eigen::Matrix4d::Zero();
  for (int i = 0; i < n; ++i)
  {
    const Quaternion q = draw_orientation(generator);
    REQUIRE(std::abs(q.norm() - 1.) < 1e-14);
    const Mat3 r = q.toRotationMatrix();
    first += r;
    second += r.cwiseAbs2();
    quaternions += q.coeffs() * q.coeffs().transpose();
  }
  CHECK((first / n).cwiseAbs().maxCoeff() < 5. / std::sqrt(3. * n));
  CHECK(((second / n).array() - 1. / 3.).abs().maxCoeff() < 5. * std::sqrt(4. / 45. / n));
  // q_i^2 has mean 1/4 and variance 1/8 - 1/16, q_i q_j variance 1/24.
  CHECK((quaternions / n - 0.25 * Eigen::Matrix4d::Identity()).cwiseAbs().maxCoeff() < 5. * 0.25 / std::sqrt(n));
}

TEST_CASE("grains are drawn up to a volume")
{
  // Stops where the next grain would miss the aim by more than half of itself: within half of the largest grain.
  const GrainDistribution sand;
  for (const double aim : {1e-12, 3e-8, 1.01e-7})
  {
    std::mt19937_64 generator(3);
    const auto grains = draw_grains(sand, aim, generator);
    double sum = 0., largest = 0.;
    for (const Superquadric &g : grains)
    {
      sum += volume(g);
      largest = std::max(largest, volume(g));
    }
    REQUIRE(!grains.empty());
    if (grains.size() > 1)
      CHECK(std::abs(sum - aim) <= 0.5 * largest * (1. + 1e-9) + 4e-10);
    std::mt19937_64 again(3);
    const auto same = draw_grains(sand, aim, again);
    REQUIRE(same.size() == grains.size());
    for (std::size_t i = 0; i < grains.size(); ++i)
      CHECK((same[i].half_axes == grains[i].half_axes && same[i].eps1 == grains[i].eps1 &&
             same[i].eps2 == grains[i].eps2));
  }
  GrainDistribution wrong;
  wrong.mean_half_axes[1] = 1.;
  std::mt19937_64 generator(3);
  CHECK_THROWS_AS(draw_grains(wrong, 1e-8, generator), ConfigError);
  wrong = {};
  wrong.largest_exponent = 2.;
  CHECK_THROWS_AS(draw_grains(wrong, 1e-8, generator), ConfigError);
}

TEST_CASE("randomly added grains neither overlap nor leave the box")
{
  const Box box{Vec3(-2e-3, 1e-3, 0.), Vec3(4e-3, 6e-3, 7e-3)};
  const auto make = [&](const int seed)
  {
    std::mt19937_64 generator(seed);
    const auto grains = draw_grains({}, 0.22 * box.volume(), generator);
    return add_at_random(grains, box, 2650., generator());
  };
  const Particles p = make(5);
  REQUIRE(p.size() > 100);
  double solid = 0.;
  std::vector<std::vector<Vec3>> surface(p.size());
  for (std::size_t i = 0; i < p.size(); ++i)
  {
    solid += volume(p.parts.shape[i]);
    CHECK(p.mass[i] == Approx(2650. * volume(p.parts.shape[i])).epsilon(1e-14));
    // Sampled, not by the support function that the placing uses.
    for (int j = -12; j <= 12; ++j)
      for (int k = -12; k < 12; ++k)
        surface[i].push_back(p.position[i] +
                             p.orientation[i] * surface_point(p.parts.shape[i], 0.5 * pi * j / 12, pi * k / 12));
    for (const Vec3 &x : surface[i])
    {
      REQUIRE((x - box.low).minCoeff() > -1e-15);
      REQUIRE((box.high - x).minCoeff() > -1e-15);
    }
  }
  CHECK(solid / box.volume() == Approx(0.22).epsilon(0.01));
  // Every pair, in both orders of the search; and no surface point of one lies inside another.
  int n_near = 0;
  for (std::size_t i = 0; i < p.size(); ++i)
    for (std::size_t j = 0; j < p.size(); ++j)
      if (i != j && (p.position[i] - p.position[j]).norm() < p.bounding_radius[i] + p.bounding_radius[j])
      {
        ++n_near;
        CHECK(find_contact(make_pose(p.parts.shape[i], p.position[i], p.orientation[i]),
                           make_pose(p.parts.shape[j], p.position[j], p.orientation[j]))
                  .status == ContactStatus::separated);
        for (const Vec3 &x : surface[i])
          REQUIRE(inside_outside(p.parts.shape[j], p.orientation[j].conjugate() * (x - p.position[j])) > 1.);
      }
  CHECK(n_near > 50); // else nothing was tried
  CHECK(pressed_positions(make(5)) == pressed_positions(p));
  CHECK(pressed_positions(make(6)) != pressed_positions(p));
}

TEST_CASE("too dense an addition is refused with the solid fraction that was reached")
{
  // Four spheres of radius 0.4 cannot share a unit cube... two can at most lie on a diagonal: with grain centres in
  // [0.4, 0.6]^3 no two are 0.8 apart, so exactly one fits and the fraction reached is 4/3 pi 0.4^3 = 0.268083.
  const std::vector<Superquadric> grains(4, {Vec3::Constant(0.4), 1., 1.});
  std::mt19937_64 generator(1);
  CHECK_THROWS_AS(add_at_random(grains, Box{Vec3::Zero(), Vec3::Ones()}, 1000., generator()), ConfigError);
  CHECK_THROWS_WITH(add_at_random(grains, Box{Vec3::Zero(), Vec3::Ones()}, 1000., generator()),
                    Catch::Contains("3 of 4 grains") && Catch::Contains("0.26808") && Catch::Contains("larger space"));
}

TEST_CASE("a packing compressed to 1 kPa rests there")
{
  omp_set_num_threads(1); // a team costs more than it gains on 200 grains
  SimulationParameters parameters;
  parameters.grain() = {1e8, 0.2, 2650.};
  parameters.wall() = parameters.grain();
  parameters.between_grains().friction = 0.24;
  parameters.set_damping(0.7);
  parameters.time_step = 4e-6;
  CompressionParameters aim;
  aim.pressure = 1000.;
  aim.largest_rate = 30.;
  aim.longest_time = 2.;
  std::mt19937_64 generator(7);
  const Box box{Vec3::Zero(), Vec3::Constant(6.4e-3)};
  const auto grains = draw_grains({}, 0.24 * box.volume(), generator);
  Simulation simulation(parameters, add_at_random(grains, box, 2650., generator()), box_walls(box));
  REQUIRE(simulation.particles.size() > 180);
  Compression compression(aim);
  std::int64_t n = 0;
  for (; !compression.is_finished() && n < 60000; ++n)
    compression.step(simulation);
  REQUIRE(compression.is_finished());
  simulation.check_finite();
  CHECK(simulation.contacts.n_undecided() == 0);

  simulation.compute_forces();
  // At its five last checks every pressure lay within 1 % and the unbalanced force below 1 %.
  const Vec3 pressure = wall_pressure(simulation.walls);
  for (int d = 0; d < 3; ++d)
  {
    CHECK(std::abs(pressure[d] / 1000. - 1.) < 0.011);
    // Both faces of a direction carry the same but for the grains' unbalanced forces.
    const double low = -simulation.walls[2 * d].force[d], high = simulation.walls[2 * d + 1].force[d];
    CHECK(std::abs(high / low - 1.) < 0.05);
  }
  CHECK(unbalanced_force(simulation) < 0.01);

  // Sand at low pressure between smooth walls: looser than its bulk (0.6) near the walls, denser than the loosest
  // (0.5); above 0.75 grains would have to overlap.
  double solid = 0.;
  for (const Superquadric &g : simulation.particles.parts.shape)
    solid += volume(g);
  const double fraction = solid / box_between(simulation.walls).volume();
  CAPTURE(n, fraction);
  CHECK(fraction > 0.5);
  CHECK(fraction < 0.75);

  // Overlaps: force on a grain ~ p (2 r)^2 = 1000 * (0.8e-3)^2 = 6e-4 N, a strong chain ten times that; Hertz with R* =
  // 0.2 mm, E* = 52 MPa: d = (f/(4/3 E* sqrt(R*)))^(2/3) = 4 micrometres, 1 % of a radius.
  double deepest = 0., kinetic = 0.;
  std::size_t n_touching = 0;
  for (const TouchingContact &contact : simulation.contacts.touching(simulation.particles))
  {
    const ContactView &s = contact.state;
    deepest = std::max(deepest, s.overlap);
    ++n_touching;
    CHECK(s.forces.tangential.norm() <= 0.24 * s.forces.normal * (1. + 1e-12));
  }
  CHECK(deepest > 0.);
  CHECK(deepest < 4e-6);
  // A stable packing of frictional grains has more than four contacts a grain, walls counted once.
  n_touching += simulation.contacts.n_touching_walls();
  CHECK(2. * n_touching / simulation.particles.size() > 4.);

  // At rest: the kinetic energy of what bears the load is far below the elastic one. Loose grains may still fly about.
  std::vector<int> n_contacts(simulation.particles.size());
  for (const auto &some :
       {simulation.contacts.touching(simulation.particles), simulation.contacts.touching_walls(simulation.particles)})
    for (const TouchingContact &contact : some)
      for (const std::int32_t i : {contact.first, contact.second})
        if (i != no_grain)
          ++n_contacts[i];
  Vec3 momentum = Vec3::Zero();
  double mass = 0., speed = 0., of_all = 0.;
  for (std::size_t i = 0; i < simulation.particles.size(); ++i)
  {
    const double m = simulation.particles.mass[i], energy = 0.5 * m * simulation.particles.velocity[i].squaredNorm();
    mass += m;
    momentum += m * simulation.particles.velocity[i];
    speed = std::max(speed, simulation.particles.velocity[i].norm());
    of_all += energy;
    if (n_contacts[i] >= 3)
      kinetic += energy;
  }
  CAPTURE(of_all);
  const GrainEnergy e = simulation.energy();
  CHECK(kinetic < 0.01 * (e.normal + e.tangential));
  CHECK(momentum.norm() <= mass * speed);
  CHECK((momentum / mass).norm() < 1e-3); // m/s; the walls came with 0.1 m/s
  // The walls' work is what is stored or lost; balance() starts from zero. The budget of motion and curvatures that
  // change with the place limit it: see the collisions of grains of any shape.
  CHECK(std::abs(e.balance()) < 1e-3 * e.wall_work);
  CHECK(e.wall_work > 0.);
  CHECK(e.friction_loss > 0.);
  CHECK(e.viscous_loss > 0.);
}
