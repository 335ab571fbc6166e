#include "fe_dealii/material/elastic_parameters.h"

#include "dem/core/error.h"

#include <cmath>
#include <sstream>

namespace bergamo::fe
{

void require_parameter(const bool holds, const char *material, const char *name, const double value, const char *rule)
{
  if (holds)
    return;
  std::ostringstream message;
  message << material << ": " << name << " = " << value << " is not allowed; " << rule;
  throw ConfigError(message.str());
}

void ElasticParameters::validate(const char *material) const
{
  // Written so that NaN fails every one.
  require_parameter(young_modulus > 0 && std::isfinite(young_modulus), material, "young_modulus [Pa]", young_modulus,
                    "give a positive number");
  require_parameter(poisson_ratio > -1 && poisson_ratio < 0.5, material, "poisson_ratio", poisson_ratio,
                    "choose it in (-1, 0.5)");
  require_parameter(density > 0 && std::isfinite(density), material, "density [kg/m^3]", density,
                    "give a positive number");
}

} // namespace bergamo::fe
