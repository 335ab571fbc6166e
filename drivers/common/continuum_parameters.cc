#include "drivers/common/continuum_parameters.h"

namespace bergamo::driver
{

void declare_continuum(ParameterFile &file, fe::MohrCoulombParameters &continuum)
{
  file.add("Continuum", "Young's modulus", continuum.young_modulus, "[Pa]", Range::positive());
  file.add("Continuum", "Poisson's ratio", continuum.poisson_ratio, "",
           {.lowest = 0, .highest = 0.5, .highest_included = false});
  file.add("Continuum", "friction angle", continuum.friction_angle, "[degree]",
           {.lowest = 0, .highest = 90, .highest_included = false});
  file.add("Continuum", "dilation angle", continuum.dilation_angle, "at most the friction angle [degree]",
           {.lowest = 0, .highest = 90, .highest_included = false});
  file.add("Continuum", "cohesion", continuum.cohesion, "[Pa]", Range::non_negative());
  file.add("Continuum", "reference pressure", continuum.reference_pressure,
           "at which Young's modulus holds; 0: it holds at any pressure [Pa]", Range::non_negative());
  file.add("Continuum", "stiffness exponent", continuum.stiffness_exponent,
           "the modulus grows as (pressure / reference pressure) to this power", Range::between(0, 1));
  file.add("Continuum", "density", continuum.density, "of the bulk: grains and voids [kg/m3]", Range::positive());
}

} // namespace bergamo::driver
