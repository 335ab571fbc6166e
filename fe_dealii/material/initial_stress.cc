#include "fe_dealii/material/initial_stress.h"

#include "fe_dealii/material/elastic_parameters.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace bergamo::fe
{

void GeostaticStress::validate() const
{
  const auto require = [](const bool holds, const char *name, const double value, const char *rule)
  { require_parameter(holds, "ground at rest", name, value, rule); };
  constexpr const char *not_negative = "give zero or a positive number";
  require(std::isfinite(surface_height), "surface_height [m]", surface_height, "give a number");
  require(unit_weight >= 0 && std::isfinite(unit_weight), "unit_weight [N/m^3]", unit_weight, not_negative);
  require(earth_pressure_at_rest >= 0 && std::isfinite(earth_pressure_at_rest), "earth_pressure_at_rest",
          earth_pressure_at_rest, not_negative);
  require(surcharge >= 0 && std::isfinite(surcharge), "surcharge [Pa]", surcharge, not_negative);
  double above = surface_height;
  for (const DeeperLayer &layer : deeper)
  {
    require(layer.top < above && std::isfinite(layer.top), "top of a layer [m]", layer.top,
            "it has to lie below the surface and the layer above");
    require(layer.unit_weight >= 0 && std::isfinite(layer.unit_weight), "unit_weight [N/m^3]", layer.unit_weight,
            not_negative);
    above = layer.top;
  }
}

InitialStress uniform_pressure(const double pressure)
{
  return [pressure](const std::array<double, 3> &) { return Stress{-pressure, -pressure, -pressure, 0, 0, 0}; };
}

InitialStress geostatic_stress(const GeostaticStress &ground)
{
  ground.validate();
  return [ground](const std::array<double, 3> &place)
  {
    double vertical = -ground.surcharge - ground.unit_weight * std::max(0., ground.surface_height - place[2]);
    double above = ground.unit_weight;
    for (const DeeperLayer &layer : ground.deeper)
    {
      vertical -= (layer.unit_weight - above) * std::max(0., layer.top - place[2]);
      above = layer.unit_weight;
    }
    const double horizontal = ground.earth_pressure_at_rest * vertical;
    return Stress{horizontal, horizontal, vertical, 0, 0, 0};
  };
}

double earth_pressure_at_rest(const double friction_angle)
{
  return 1 - std::sin(friction_angle * std::numbers::pi / 180);
}

} // namespace bergamo::fe
