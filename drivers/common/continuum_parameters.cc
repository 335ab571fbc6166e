#include "drivers/common/continuum_parameters.h"

namespace bergamo::driver
{

void declare_continuum(ParameterFile &file, fe::MohrCoulombParameters &continuum, const std::string &section)
{
  file.add(section, "Young's modulus", continuum.young_modulus, "[Pa]", Range::positive());
  file.add(section, "Poisson's ratio", continuum.poisson_ratio, "",
           {.lowest = 0, .highest = 0.5, .highest_included = false});
  file.add(section, "friction angle", continuum.friction_angle, "[degree]",
           {.lowest = 0, .highest = 90, .highest_included = false});
  file.add(section, "dilation angle", continuum.dilation_angle, "at most the friction angle [degree]",
           {.lowest = 0, .highest = 90, .highest_included = false});
  file.add(section, "cohesion", continuum.cohesion, "[Pa]", Range::non_negative());
  file.add(section, "reference pressure", continuum.reference_pressure,
           "at which Young's modulus holds; 0: it holds at any pressure [Pa]", Range::non_negative());
  file.add(section, "stiffness exponent", continuum.stiffness_exponent,
           "the modulus grows as (pressure / reference pressure) to this power", Range::between(0, 1));
  file.add(section, "density", continuum.density, "of the bulk: grains and voids [kg/m3]", Range::positive());
}

} // namespace bergamo::driver
