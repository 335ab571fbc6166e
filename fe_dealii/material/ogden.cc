#include "fe_dealii/material/ogden.h"

#include <cmath>

namespace bergamo::fe
{

void OgdenParameters::validate() const
{
  constexpr const char *name = "Ogden material";
  for (int n = 0; n < 3; ++n)
  {
    require_parameter(std::isfinite(modulus[n]), name, "modulus [Pa]", modulus[n], "give a number");
    require_parameter(std::isfinite(exponent[n]) && (exponent[n] != 0 || modulus[n] == 0), name, "exponent",
                      exponent[n], "give a number that is not zero");
    require_parameter(modulus[n] * exponent[n] >= 0, name, "modulus times exponent [Pa]", modulus[n] * exponent[n],
                      "choose both of one sign (Ogden 1972), otherwise the material loses its stability");
  }
  require_parameter(shear_modulus() > 0, name, "shear modulus [Pa]", shear_modulus(),
                    "give at least one term a modulus other than zero");
  require_parameter(bulk_modulus > 0 && std::isfinite(bulk_modulus), name, "bulk_modulus [Pa]", bulk_modulus,
                    "give a positive number, e.g. 50 shear moduli");
  require_parameter(density > 0 && std::isfinite(density), name, "density [kg/m^3]", density, "give a positive number");
}

} // namespace bergamo::fe
