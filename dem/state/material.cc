#include "dem/state/material.h"

#include "dem/core/error.h"

#include <cmath>

namespace bergamo::dem
{

void Material::validate() const
{
  require(young_modulus > 0. && std::isfinite(young_modulus), "Young's modulus", young_modulus, "positive [Pa]");
  require(poisson_ratio >= 0. && poisson_ratio < 0.5, "Poisson's ratio", poisson_ratio, "in [0, 0.5)");
  require(density > 0. && std::isfinite(density), "density", density, "positive [kg/m^3]");
}

} // namespace bergamo::dem
