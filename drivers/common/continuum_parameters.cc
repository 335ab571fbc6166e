#include "drivers/common/continuum_parameters.h"

#include "dem/core/error.h"

namespace bergamo::driver
{
namespace
{

void declare_mohr_coulomb(ParameterFile &file, const std::string &section, fe::MohrCoulombParameters &continuum)
{
  file.add(section, "Young's modulus", continuum.young_modulus, "[Pa]", Range::positive().usual(1e4, 1e12));
  file.add(section, "Poisson's ratio", continuum.poisson_ratio, "",
           {.lowest = 0, .highest = 0.5, .highest_included = false});
  file.add(section, "friction angle", continuum.friction_angle, "[degree]",
           Range{.lowest = 0, .highest = 90, .highest_included = false}.usual(5, 60));
  file.add(section, "dilation angle", continuum.dilation_angle,
           "at most the friction angle; negative for loose sand, which contracts [degree]",
           Range::strictly_between(-90, 90));
  file.add(section, "cohesion", continuum.cohesion, "[Pa]", Range::non_negative());
  file.add(section, "reference pressure", continuum.reference_pressure,
           "at which Young's modulus holds; 0: it holds at any pressure [Pa]", Range::non_negative());
  file.add(section, "stiffness exponent", continuum.stiffness_exponent,
           "the modulus grows as (pressure / reference pressure) to this power", Range::between(0, 1));
  file.add(
      section, "hardening strain", continuum.hardening_strain,
      "plastic strain that mobilises half of what the friction has to gain; the dilation follows it (Rowe); 0: all "
      "is there at once",
      Range::non_negative().usual(1e-5, 0.5));
  file.add(section, "initial friction angle", continuum.initial_friction_angle,
           "that the hardening begins with [degree]",
           Range{.lowest = 0, .highest = 90, .lowest_included = false, .highest_included = false}.usual(1, 60));
  file.add(section, "density", continuum.density, "of the bulk: grains and voids, by either law [kg/m3]",
           Range::positive().usual(500, 5000));
}

void declare_sand(ParameterFile &file, const std::string &section, fe::HypoplasticParameters &sand)
{
  file.add(section, "critical friction angle", sand.critical_friction_angle, "phi_c, of steady flow [degree]",
           Range::strictly_between(0, 90).usual(15, 50));
  file.add(section, "granulate hardness", sand.granulate_hardness, "h_s of Bauer's law of compression [Pa]",
           Range::positive().usual(1e6, 1e12));
  file.add(section, "compression exponent", sand.compression_exponent, "n of the same",
           Range::strictly_between(0, 1).usual(0.05, 0.9));
  file.add(section, "densest void ratio", sand.densest_void_ratio, "e_d0, without pressure",
           Range::positive().usual(0.2, 2));
  file.add(section, "critical void ratio", sand.critical_void_ratio, "e_c0, without pressure, above the densest",
           Range::positive().usual(0.3, 3));
  file.add(section, "loosest void ratio", sand.loosest_void_ratio, "e_i0, without pressure, at least the critical",
           Range::positive().usual(0.3, 4));
  file.add(section, "pyknotropy exponent", sand.pyknotropy_exponent, "alpha: how density raises the peak strength",
           Range::non_negative());
  file.add(section, "stiffness exponent", sand.stiffness_exponent, "beta: how density raises the stiffness",
           Range::non_negative());
  file.add(section, "void ratio", sand.initial_void_ratio,
           "at the start, everywhere; between the densest and the loosest of the pressure there",
           Range::positive().usual(0.2, 4));
  file.add(section, "least pressure", sand.least_pressure,
           "below this mean pressure the stiffness stays that of it [Pa]", Range::positive());
}

} // namespace

void ContinuumParameters::declare(ParameterFile &file, const std::string &section)
{
  file.add(
      section, "law", law,
      "Mohr-Coulomb, or hypoplasticity after von Wolffersdorff, which takes the section Sand and the density alone",
      {{"Mohr-Coulomb", ContinuumLaw::mohr_coulomb}, {"hypoplastic sand", ContinuumLaw::hypoplastic_sand}});
  declare_mohr_coulomb(file, section, mohr_coulomb);
  declare_sand(file, section + "/Sand", sand);
}

void ContinuumParameters::validate() const
{
  if (is_sand())
    sand.validate();
  else
    mohr_coulomb.validate();
}

void ContinuumParameters::require_pressure(const double pressure, const std::string &place,
                                           const std::string &remedy) const
{
  if (is_sand() && pressure < sand.least_pressure)
    reject("Continuum/Sand/least pressure is ", sand.least_pressure, " Pa, but ", place, " a mean pressure of ",
           pressure, " Pa at rest, where the law of sand does not hold; ", remedy, ", or lower it");
}

fe::Material ContinuumParameters::material() const
{
  if (!is_sand())
    return fe::MohrCoulomb(mohr_coulomb);
  fe::HypoplasticParameters of_bulk = sand;
  of_bulk.density = density();
  return fe::HypoplasticSand(of_bulk);
}

} // namespace bergamo::driver
