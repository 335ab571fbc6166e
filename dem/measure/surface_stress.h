#pragma once

#include "dem/force/touching_contact.h"
#include "dem/state/surface.h"

#include <span>
#include <vector>

namespace bergamo::dem
{

/// What grains exert on the triangles of one surface at this step, with the contacts' weights, by triangle.
struct SurfaceStress
{
  std::vector<double> pressure;     ///< sum of the normal forces over the area, compression positive [Pa]
  std::vector<double> shear_stress; ///< length of the sum of the tangential forces over the area [Pa]
  std::vector<Vec3> traction;       ///< sum of the forces over the area, global; on the surface [Pa]
};

/// Stresses of all surfaces, one entry each. A contact on a face is that face's; one on an edge is shared by halves
/// between its faces, at a rim all is the one face's; one on a vertex is shared by the angles that the faces have
/// there. Places on concave edges count -1, so they take from both faces what these have twice. Normal and tangential
/// are those of the contact, not of the triangle: at an edge that grains press on squarely there is no shear. Tractions
/// times areas add up to the force on the surface.
/// @param contacts with surfaces among them, as Contacts::touching_walls() lists them
std::vector<SurfaceStress> surface_stress(std::span<const Surface> surfaces, std::span<const TouchingContact> contacts);

} // namespace bergamo::dem
