#pragma once

#include "dem/measure/part_loads.h"
#include "drivers/common/parameter_file.h"
#include "fe_dealii/conditions/rigid_body.h"

#include <string>

namespace bergamo::driver
{

enum class IntruderKind
{
  plate, ///< a blade: rectangular section, its edge down
  cone,  ///< round, with a conical or a flat tip
  pile   ///< plane strain: from the box's front to its back
};

/// Number of an intruder's material, after those of grains and walls.
inline constexpr std::int32_t intruder_material = 2;

/// Parts of an intruder's surface.
inline constexpr std::int32_t tip_part = 0, shaft_part = 1;

/// A body upright about z, its lowest point at the origin, with a tip and a shaft on it. SI units.
struct IntruderShape
{
  IntruderKind kind = IntruderKind::pile;
  double width = 4e-3;         ///< along x; diameter of a cone [m]
  double breadth = 6e-3;       ///< along y, of plate and pile [m]
  double tip_angle = 180.;     ///< full angle of the tip, 180: flat [degrees]
  int n_facets = 32;           ///< around a cone
  double triangle_size = 2e-3; ///< at most [m]

  /// Binds all but kind and breadth to a section, "Intruder" or "Pile".
  void declare(ParameterFile &file, const std::string &section);

  double tip_height() const; ///< [m]
  double tip_area() const;   ///< seen from below [m²]
};

/// The triangles of an intruder, and which of them are tip and shaft.
struct Intruder
{
  fe::RigidBodyShape body; ///< without mass; guided along z, and held otherwise
  dem::SurfaceParts parts; ///< of surface 0
};

/// Open at its top; a pile is open at its sides, too, which lie beyond those of the box.
/// @param lowest place of the lowest point [m]; @param height of it all [m], above the tip's;
/// @param overhang of a pile beyond its breadth, on each side [m]
Intruder make_intruder(const IntruderShape &shape, const Vec3 &lowest, double height, double overhang);

} // namespace bergamo::driver
