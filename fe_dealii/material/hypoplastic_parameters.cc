#include "fe_dealii/material/hypoplastic_parameters.h"

#include "fe_dealii/material/elastic_parameters.h"

#include <cmath>
#include <numbers>

namespace bergamo::fe
{

double HypoplasticParameters::strength_factor() const
{
  const double sine = std::sin(critical_friction_angle * std::numbers::pi / 180);
  return std::numbers::sqrt3 * (3 - sine) / (2 * std::numbers::sqrt2 * sine);
}

double HypoplasticParameters::loosest_compression() const
{
  const double a = strength_factor();
  const double looseness = (loosest_void_ratio - densest_void_ratio) / (critical_void_ratio - densest_void_ratio);
  return 3 + a * a - std::numbers::sqrt3 * a * std::pow(looseness, pyknotropy_exponent);
}

void HypoplasticParameters::validate() const
{
  const auto require = [](const bool holds, const char *name, const double value, const char *rule)
  { require_parameter(holds, "hypoplastic sand", name, value, rule); };
  // Written so that NaN fails every one.
  require(critical_friction_angle > 0 && critical_friction_angle < 90, "critical_friction_angle [degrees]",
          critical_friction_angle, "choose it in (0, 90); about 30 for quartz sands");
  require(granulate_hardness > 0 && std::isfinite(granulate_hardness), "granulate_hardness [Pa]", granulate_hardness,
          "give a positive number; about 1e9 for quartz sands");
  require(compression_exponent > 0 && compression_exponent < 1, "compression_exponent", compression_exponent,
          "choose it in (0, 1); about 0.3 for quartz sands");
  require(densest_void_ratio > 0 && std::isfinite(densest_void_ratio), "densest_void_ratio", densest_void_ratio,
          "give a positive number");
  require(critical_void_ratio > densest_void_ratio && std::isfinite(critical_void_ratio), "critical_void_ratio",
          critical_void_ratio, "it must be greater than the densest void ratio");
  require(loosest_void_ratio >= critical_void_ratio && std::isfinite(loosest_void_ratio), "loosest_void_ratio",
          loosest_void_ratio, "it must be at least the critical void ratio; 1.15 times that is usual");
  require(pyknotropy_exponent >= 0 && std::isfinite(pyknotropy_exponent), "pyknotropy_exponent", pyknotropy_exponent,
          "give zero or a positive number; 0.1 to 0.3 is usual");
  require(stiffness_exponent >= 0 && std::isfinite(stiffness_exponent), "stiffness_exponent", stiffness_exponent,
          "give zero or a positive number; 1 to 1.5 is usual");
  require(loosest_compression() > 0, "pyknotropy_exponent", pyknotropy_exponent,
          "with these void ratios the loosest sand would soften in compression; choose a smaller one");
  require(initial_void_ratio > 0 && std::isfinite(initial_void_ratio), "initial_void_ratio", initial_void_ratio,
          "give a positive number between the densest and the loosest void ratio of the pressure at the start");
  require(density > 0 && std::isfinite(density), "density [kg/m^3]", density, "give a positive number");
  require(least_pressure > 0 && std::isfinite(least_pressure), "least_pressure [Pa]", least_pressure,
          "give a positive number, small beside the pressures that matter");
}

} // namespace bergamo::fe
