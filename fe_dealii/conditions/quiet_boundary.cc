#include "fe_dealii/conditions/quiet_boundary.h"

#include "dem/core/error.h"
#include "fe_dealii/boundary/surface_load.h"
#include "fe_dealii/explicit_body.h"

namespace bergamo::fe
{

std::vector<Dashpot> quiet_boundary(const ExplicitBody &body, const unsigned int boundary_id)
{
  const SurfaceLoad faces(boundary_surface(body.dof_handler(), boundary_id), body.node_position());
  const Surface &surface = faces.surface();
  std::vector<Dashpot> dashpots;
  for (std::size_t face = 0; face < surface.size(); ++face)
  {
    const unsigned int element = surface.elements[face];
    const Material &material = body.material(element);
    const double normal = density(material) * p_wave_speed(material),
                 tangential = density(material) * s_wave_speed(material);
    for (int k = 0; k < surface.nodes_per_face(); ++k)
    {
      const NodalArea part = faces.nodal_area(face, k);
      if (!(part.area > 0))
        reject("quiet boundary ", boundary_id, ": node ", surface.face(face)[k], " has no part of the face of element ",
               element, ", so distorted is it; repair the mesh there");
      Dashpot dashpot{surface.face(face)[k], element, {}};
      for (int i = 0; i < 6; ++i)
        dashpot.viscosity[i] = (normal - tangential) * part.normals[i] + (i < 3 ? tangential * part.area : 0);
      dashpots.push_back(dashpot);
    }
  }
  return dashpots;
}

} // namespace bergamo::fe
