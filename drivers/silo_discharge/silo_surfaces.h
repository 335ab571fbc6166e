#pragma once

#include "dem/state/surface.h"

#include <string>
#include <vector>

namespace bergamo::driver
{

/// A box open at the top, of which strips of the floor can be taken out: x across them, y along, z upwards, the middle
/// of the floor at the origin. SI units.
struct SiloShape
{
  double width, depth, height;        ///< [m]
  std::vector<double> orifice_widths; ///< ascending, below the width [m]
  double triangle_size;               ///< longest leg of a triangle [m]
};

/// The surfaces of a closed silo, with names: four walls, the floor but for the widest orifice, and a plug for each
/// orifice that is wider than those before it by two strips. The first orifice is open without its plug, the second
/// without the first two, and so on.
struct SiloSurfaces
{
  std::vector<std::string> names;
  std::vector<dem::Surface> surfaces;
  std::size_t first_plug;
};

SiloSurfaces make_silo(const SiloShape &shape);

} // namespace bergamo::driver
