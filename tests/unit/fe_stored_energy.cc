// The energy that a stress stores where the moduli grow with the pressure.

#include "fe_dealii/material/mohr_coulomb.h"

#include <catch2/catch.hpp>

using namespace bergamo::fe;

TEST_CASE("stored energy: dU = p dp/K over the pressure, J2/2G over shear, none without stress", "[fe]")
{
  const double exponent = GENERATE(0., 1. / 3, 0.5, 1.);
  const MohrCoulomb sand({.reference_pressure = 1e5, .stiffness_exponent = exponent});
  CAPTURE(exponent);
  CHECK(sand.elastic_energy_density(0., 0.) == 0);
  for (const double pressure : {-500., 200., 999.9, 1000.1, 2e3, 5e4, 1e5, 3e6}) // both sides of a hundredth of p_r
  {
    CAPTURE(pressure);
    const double h = 1e-5 * std::abs(pressure), factor = sand.stiffness_factor(-pressure);
    const double slope =
        (sand.elastic_energy_density(-pressure - h, 0.) - sand.elastic_energy_density(-pressure + h, 0.)) / (2 * h);
    // Central differences across the kink at a hundredth of p_r are of first order, elsewhere of second.
    CHECK(slope == Approx(pressure / (factor * sand.bulk_modulus())).epsilon(1e-5));
    CHECK(sand.elastic_energy_density(-pressure, 7e8) - sand.elastic_energy_density(-pressure, 0.) ==
          Approx(7e8 / (2 * factor * sand.shear_modulus())).epsilon(1e-9));
  }
}

TEST_CASE("stored energy: without dependence on the pressure half of stress times strain", "[fe]")
{
  const MohrCoulomb sand{MohrCoulombParameters()};
  const Stress stress{-3e4, 1e4, -5e4, 2e4, -1e4, 4e3};
  CHECK(sand.elastic_energy_density(mean_stress(stress), second_invariant(stress)) ==
        Approx(0.5 * energy_density(stress, sand.elastic_strain(stress))).epsilon(1e-13));
}
