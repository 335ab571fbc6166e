// Mohr-Coulomb paths at one point against closed forms (tension positive; p is a positive confining pressure).
#include "fe_dealii/material/mohr_coulomb.h"
#include "fe_dealii/material/principal.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

using namespace bergamo::fe;

namespace
{

struct Path
{
  Stress stress;
  Strain strain{}, plastic{};
  double last_ratio = 0; // d(volumetric plastic) / d|axial plastic| in the last step
  Sector sector;
};

// Drives component zz by `axial` in `steps`, holding the listed lateral stresses by Newton's method on lateral strains
// with the elastic modulus (the mixed control of a test cell).
Path drive(const MohrCoulomb &material, const double pressure, const double axial, const bool hold_x, const bool hold_y)
{
  Path path;
  path.stress = {-pressure, -pressure, -pressure, 0, 0, 0};
  const int steps = 2000;
  for (int step = 0; step < steps; ++step)
  {
    Strain increment{0, 0, axial / steps, 0, 0, 0};
    StressUpdate update;
    for (int iteration = 0; iteration < 2000; ++iteration)
    {
      update = material.update(path.stress, increment);
      const double rx = hold_x ? update.stress[0] + pressure : 0, ry = hold_y ? update.stress[1] + pressure : 0;
      if (std::abs(rx) + std::abs(ry) < 1e-9 * pressure)
        break;
      const double modulus = material.lame_modulus() * 2 + 2 * material.shear_modulus();
      increment[0] -= rx / modulus;
      increment[1] -= ry / modulus;
    }
    for (int i = 0; i < 6; ++i)
    {
      path.strain[i] += increment[i];
      path.plastic[i] += update.plastic_strain[i];
    }
    const Strain &p = update.plastic_strain;
    path.last_ratio = (p[0] + p[1] + p[2]) / std::abs(p[2]);
    path.stress = update.stress;
    path.sector = update.sector;
  }
  return path;
}

const MohrCoulombParameters parameters = []
{
  MohrCoulombParameters p;
  p.cohesion = 2000;
  return p;
}();
const double phi = parameters.friction_angle * std::numbers::pi / 180;
const double psi = parameters.dilation_angle * std::numbers::pi / 180;
const double n_phi = (1 + std::sin(phi)) / (1 - std::sin(phi));
const double n_psi = (1 + std::sin(psi)) / (1 - std::sin(psi));
constexpr double confining = 50e3;

} // namespace

TEST_CASE("Triaxial compression: strength -(p N + 2 c sqrt N), dilation by N_psi, elastic slope E", "[fe]")
{
  const MohrCoulomb material(parameters);
  const double strength = confining * n_phi + 2 * parameters.cohesion * std::sqrt(n_phi);
  const Path path = drive(material, confining, -0.01, true, true);
  CHECK(path.sector == Sector::left_edge);
  CHECK(path.stress[2] == Approx(-strength).epsilon(1e-8));
  CHECK(path.stress[0] == Approx(-confining).epsilon(1e-8));
  // Flow of the planes (σ1, σ3) and (σ2, σ3) in equal parts: axial −(1 − sin ψ), volumetric 2 sin ψ, each per unit.
  CHECK(path.last_ratio == Approx(n_psi - 1).epsilon(1e-6));
  const double elastic = (strength - confining) / parameters.young_modulus;
  CHECK(path.plastic[2] == Approx(-0.01 + elastic).epsilon(1e-8));

  const Path small = drive(material, confining, -0.5 * elastic, true, true);
  CHECK(small.stress[2] == Approx(-confining - 0.5 * (strength - confining)).epsilon(1e-9));
  CHECK(small.strain[0] == Approx(0.5 * elastic * parameters.poisson_ratio).epsilon(1e-6));
}

TEST_CASE("Triaxial extension: axial stress -(p / N - 2 c / sqrt N)", "[fe]")
{
  const MohrCoulomb material(parameters);
  const Path path = drive(material, confining, 0.01, true, true);
  CHECK(path.sector == Sector::right_edge);
  CHECK(path.stress[2] == Approx(-confining / n_phi + 2 * parameters.cohesion / std::sqrt(n_phi)).epsilon(1e-8));
  // Axial 1 + sin ψ, volumetric 2 sin ψ per unit.
  CHECK(path.last_ratio == Approx(1 - 1 / n_psi).epsilon(1e-6));
}

TEST_CASE("Plane strain compression: the same strength, the middle stress by elasticity alone", "[fe]")
{
  const MohrCoulomb material(parameters);
  const Path path = drive(material, confining, -0.01, true, false); // ε_yy = 0
  const double strength = confining * n_phi + 2 * parameters.cohesion * std::sqrt(n_phi);
  CHECK(path.sector == Sector::main_plane);
  CHECK(path.stress[2] == Approx(-strength).epsilon(1e-8));
  // The main plane has no flow along the middle axis, so ε_yy^e = 0: Δσ_yy = ν (Δσ_xx + Δσ_zz), Δσ_xx = 0.
  CHECK(path.plastic[1] == Approx(0).margin(1e-14));
  CHECK(path.stress[1] == Approx(-confining - parameters.poisson_ratio * (strength - confining)).epsilon(1e-8));
  CHECK(path.last_ratio == Approx(n_psi - 1).epsilon(1e-6));
}

TEST_CASE("Hydrostatic tension: elastic with 3K up to the apex c cot phi, constant there, also without dilation or "
          "with contraction",
          "[fe]")
{
  for (const double dilation : {-5., 0., 5.17, 23.15})
  {
    MohrCoulombParameters p = parameters;
    p.dilation_angle = dilation;
    const MohrCoulomb material(p);
    const double apex = p.cohesion / std::tan(phi);
    const double limit = apex / (3 * material.bulk_modulus());
    const Strain below{0.99 * limit, 0.99 * limit, 0.99 * limit, 0, 0, 0};
    CHECK(material.update({}, below).sector == Sector::elastic);
    CHECK(material.update({}, below).stress[0] == Approx(0.99 * apex));
    const Strain above{5 * limit, 5 * limit, 5 * limit, 0, 0, 0};
    const StressUpdate update = material.update({}, above);
    CHECK(update.sector == Sector::apex);
    for (int i = 0; i < 3; ++i)
    {
      CHECK(update.stress[i] == Approx(apex));
      CHECK(update.plastic_strain[i] == Approx(4 * limit));
    }
  }
}

TEST_CASE("Simple shear without dilation from a hydrostatic state: shear stress p sin phi + c cos phi", "[fe]")
{
  // ψ = 0 keeps the mean stress at −p, and σ2 = −p lies in the middle: (σ1 − σ3)/2 = p sin φ + c cos φ.
  MohrCoulombParameters p = parameters;
  p.dilation_angle = 0;
  const MohrCoulomb material(p);
  Stress stress{-confining, -confining, -confining, 0, 0, 0};
  for (int step = 0; step < 1000; ++step)
    stress = material.update(stress, {0, 0, 0, 1e-5, 0, 0}).stress;
  CHECK(stress[3] == Approx(confining * std::sin(phi) + p.cohesion * std::cos(phi)).epsilon(1e-8));
  CHECK(stress[0] == Approx(-confining).epsilon(1e-10));
}

TEST_CASE("Loose sand sheared at constant volume loses its pressure as it contracts", "[fe]")
{
  // Triaxial compression from p0 without a change of volume, q = σ1 − σ3. Elastic, q = 3 G ε at a constant p. On the
  // edge q = M p + k; with D = 2 sin ψ/(1 − sin ψ) of volume per unit of axial flow λ: p' = K D λ and
  // q' = 3 G (1 − λ (1 + D/3)) by axial strain, so λ = 3 G/(3 G (1 + D/3) + M K D).
  MohrCoulombParameters p = parameters;
  p.dilation_angle = -8;
  const MohrCoulomb material(p);
  const double sine = std::sin(phi), contraction = std::sin(p.dilation_angle * std::numbers::pi / 180);
  const double slope = 6 * sine / (3 - sine), start = 6 * p.cohesion * std::cos(phi) / (3 - sine);
  const double d = 2 * contraction / (1 - contraction), k = material.bulk_modulus(), g = material.shear_modulus();
  const double flow = 3 * g / (3 * g * (1 + d / 3) + slope * k * d);
  const double at_yield = (slope * confining + start) / (3 * g);

  Stress stress{-confining, -confining, -confining, 0, 0, 0};
  const double axial = 2 * at_yield; // twice as far as to the yield surface, in steps that meet it
  const int steps = 1000;
  for (int step = 0; step < steps; ++step)
    stress = material.update(stress, {0.5 * axial / steps, 0.5 * axial / steps, -axial / steps, 0, 0, 0}).stress;
  const double pressure = confining + k * d * flow * (axial - at_yield);
  CHECK(pressure < 0.9 * confining);
  CHECK(-mean_stress(stress) == Approx(pressure).epsilon(1e-8));
  CHECK(stress[0] - stress[2] == Approx(slope * pressure + start).epsilon(1e-8));
}
