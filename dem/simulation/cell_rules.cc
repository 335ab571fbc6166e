#include "dem/simulation/cell_rules.h"

#include "dem/core/error.h"

#include <sstream>

namespace bergamo::dem
{

void require_walls_fit(const PeriodicCell &cell, const std::span<const PlaneWall> walls)
{
  if (!cell.is_periodic() || walls.empty())
    return;
  for (std::size_t w = 0; w < walls.size(); ++w)
    for (int d = 0; d < 3; ++d)
    {
      if (!cell.is_periodic(d) || walls[w].normal[d] == 0.)
        continue;
      std::ostringstream message;
      message << "wall " << w << " (counted from 0) has the normal (" << walls[w].normal.transpose()
              << "), but the periodic cell repeats itself along "
              << "xyz"[d]
              << ": grains would come upon it again and again; leave it out, turn it so that this component is exactly "
                 "zero, or give the cell an infinite edge along "
              << "xyz"[d];
      throw ConfigError(message.str());
    }
  if (cell.rate == Vec3::Zero() && cell.acceleration == Vec3::Zero())
    return;
  std::ostringstream message;
  message << "a periodic cell between walls keeps its edges, but theirs change by (" << cell.rate.transpose()
          << ") m/s and (" << cell.acceleration.transpose()
          << ") m/s^2: a grain and its images would slide along a wall at different speeds; set both to zero or leave "
             "out the walls";
  throw ConfigError(message.str());
}

void require_gravity_fits(const PeriodicCell &cell, const Vec3 &gravity)
{
  for (int d = 0; d < 3; ++d)
  {
    if (!cell.is_periodic(d) || gravity[d] == 0.)
      continue;
    std::ostringstream message;
    message << "gravity is (" << gravity.transpose() << ") m/s^2, but the periodic cell repeats itself along "
            << "xyz"[d]
            << ": it would fall for ever; set this component to zero, or give the cell an infinite edge along "
            << "xyz"[d];
    throw ConfigError(message.str());
  }
}

void require_no_cell_of_surfaces(const PeriodicCell &cell)
{
  if (cell.is_periodic())
    throw ConfigError("a surface was given, but grains repeat themselves in a periodic cell along " +
                      cell.directions() +
                      ": a surface does not, and contacts with one end where a grain is put back into the cell; use "
                      "planes along the cell, or leave out the cell");
}

} // namespace bergamo::dem
