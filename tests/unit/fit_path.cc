// The triaxial path of one element, over all parameters that a fit may meet.

#include "drivers/fit_mohr_coulomb/triaxial_path.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

using namespace bergamo;
using namespace bergamo::driver;

namespace
{

/// Draws of what a fit may meet: soft and stiff, weak and strong, far from its reference pressure or not.
class Draw
{
public:
  double between(const double low, const double high) { return std::uniform_real_distribution(low, high)(random_); }
  double over_decades(const double low, const double high) { return std::exp(between(std::log(low), std::log(high))); }

  fe::MohrCoulombParameters material()
  {
    fe::MohrCoulombParameters p;
    p.young_modulus = over_decades(1e6, 1e10);
    p.poisson_ratio = between(0, 0.49);
    p.friction_angle = between(1, 60);
    p.dilation_angle = between(0, 1) * p.friction_angle;
    p.cohesion = between(0, 1) < 0.3 ? 0 : over_decades(1, 1e6);
    p.reference_pressure = over_decades(1e2, 1e7);
    p.stiffness_exponent = between(0, 1);
    return p;
  }

private:
  std::mt19937_64 random_{1};
};

} // namespace

TEST_CASE("the pressure is held on any path of a material whose stiffness grows with it")
{
  Draw draw;
  int n_failed = 0, n_off = 0, n_beyond = 0;
  for (int k = 0; k < 20000; ++k)
  {
    const fe::MohrCoulombParameters p = draw.material();
    const double pressure = draw.over_decades(1e2, 1e7), end = draw.over_decades(1e-4, 0.3);
    const int n_steps = static_cast<int>(draw.between(1, 30));
    std::vector<double> strains;
    for (int step = 1; step <= n_steps; ++step)
      strains.push_back(-end * step / n_steps);
    try
    {
      const TriaxialCurve curve = drive_triaxial(fe::MohrCoulomb(p), {pressure, 0.6}, strains);
      const double t = std::tan((45 + 0.5 * p.friction_angle) * std::numbers::pi / 180);
      const double strength = pressure * t * t + 2 * p.cohesion * t;
      for (std::size_t i = 0; i < curve.size(); ++i)
      {
        // Rounding of a trial stress, which a large step makes greater than all that is left of it, on top.
        const double trial = p.young_modulus / (1 - 2 * p.poisson_ratio) *
                             std::pow(std::max(1., strength / p.reference_pressure), p.stiffness_exponent) * end;
        n_off += std::abs(curve.lateral_stress[i] + pressure) > 1e-9 * pressure + 1e-12 * trial;
        n_beyond += -curve.axial_stress[i] > strength * (1 + 1e-9) + 1e-11 * trial;
      }
    }
    catch (const std::exception &)
    {
      ++n_failed;
    }
  }
  CHECK(n_failed == 0);
  CHECK(n_off == 0);
  CHECK(n_beyond == 0);
}

TEST_CASE("moduli in proportion to the pressure: the deviator grows as 3 p (exp(E eps/3 p_r) - 1)")
{
  fe::MohrCoulombParameters p;
  p.young_modulus = 20e6;
  p.cohesion = 1e9; // no flow
  p.reference_pressure = 1e5;
  p.stiffness_exponent = 1;
  const double pressure = 4e4, end = 5e-3;
  double error[2];
  for (int k = 0; k < 2; ++k)
  {
    const int n = 500 * (k + 1);
    std::vector<double> strains;
    for (int step = 1; step <= n; ++step)
      strains.push_back(-end * step / n);
    const TriaxialCurve curve = drive_triaxial(fe::MohrCoulomb(p), {pressure, 0.6}, strains);
    const double exact = 3 * pressure * (std::exp(p.young_modulus * end / (3 * p.reference_pressure)) - 1);
    error[k] = std::abs(-curve.axial_stress.back() - pressure - exact) / exact;
  }
  CHECK(error[0] < 1e-3);
  CHECK(error[1] == Approx(error[0] / 2).epsilon(0.02)); // of first order: the stiffness of a step is that at its start
}

TEST_CASE("a friction that plastic strain mobilises follows the integral of its flow")
{
  // Under triaxial compression a unit of flow is 1 − s along the axis and counts 1 − s/3 as plastic strain.
  const fe::MohrCoulombParameters p{.young_modulus = 2e8,
                                    .poisson_ratio = 0.1,
                                    .friction_angle = 32,
                                    .dilation_angle = 6,
                                    .cohesion = 0,
                                    .hardening_strain = 2e-3};
  const fe::MohrCoulomb material(p);
  const double pressure = 1e5, end = 0.01;
  std::vector<double> strains;
  const int n_steps = 4000;
  for (int step = 1; step <= n_steps; ++step)
    strains.push_back(-end * step / n_steps);
  const TriaxialCurve curve = drive_triaxial(material, {pressure, 0.6}, strains);
  const double plastic = end - (-curve.axial_stress.back() - pressure) / p.young_modulus;
  double flowed = 0, strain = 0;
  for (const double step = 1e-7; flowed < plastic; strain += step)
  {
    const double s = material.sine_of_dilation(material.sine_of_friction(strain));
    flowed += step * (1 - s) / (1 - s / 3);
  }
  const double friction = material.sine_of_friction(strain);
  CHECK(-curve.axial_stress.back() / pressure == Approx((1 + friction) / (1 - friction)).epsilon(1e-3));
  CHECK(friction < 0.9 * std::sin(p.friction_angle * std::numbers::pi / 180));
}
