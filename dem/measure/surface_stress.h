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
  std::vector<double> pressure;      ///< sum of the normal forces over the area, compression positive [Pa]
  std::vector<double> shear_stress;  ///< length of the sum of the tangential forces over the area [Pa]
  std::vector<Vec3> traction;        ///< sum of the forces over the area, global; on the surface [Pa]
  std::vector<double> friction_work; ///< since the accounts were opened, over the area: what wears it [J/m^2]
};

/// Stresses of all surfaces, one entry each. A contact on a face is that face's; one on an edge is shared by halves
/// between its faces, at a rim all is the one face's; one on a vertex is shared by the angles that the faces have
/// there. Places on concave edges count -1, so they take from both faces what these have twice. Normal and tangential
/// are those of the contact, not of the triangle: at an edge that grains press on squarely there is no shear. Tractions
/// times areas add up to the force on the surface, friction's work times areas to what friction has lost there. Where a
/// contact goes over from triangle to triangle, what its tangential spring holds goes with it: the one that it leaves
/// counts that as lost, the one that it comes to as gained.
/// @param contacts with surfaces among them, as Contacts::touching_walls() lists them
/// @param friction_work by feature, as Contacts::friction_work() gives it; none, if empty
std::vector<SurfaceStress> surface_stress(std::span<const Surface> surfaces, std::span<const TouchingContact> contacts,
                                          std::span<const double> friction_work = {});

} // namespace bergamo::dem
