#include "dem/state/wall.h"

#include "dem/core/error.h"

#include <cmath>
#include <string>

namespace bergamo::dem
{

void PlaneWall::validate(const std::int32_t n_materials) const
{
  constexpr double tolerance = 1e-9;
  require(std::abs(normal.norm() - 1.) < tolerance, "length of a wall's normal", normal.norm(),
          "1: normalise it, and let it point to the grains");
  require(point.allFinite(), "point of a wall", point.sum(), "finite [m]");
  require(velocity.allFinite() && drift_velocity.allFinite(), "velocity of a wall", velocity.sum(), "finite [m/s]");
  require(material >= 0 && material < n_materials, "material of a wall", material,
          "the number of one of the " + std::to_string(n_materials) + " materials of the table, counted from 0");
}

} // namespace bergamo::dem
