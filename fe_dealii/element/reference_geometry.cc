#include "fe_dealii/element/reference_geometry.h"

#include "fe_dealii/error.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/grid/tria.h>

#include <string>

namespace bergamo::fe
{

std::vector<hexahedron::Geometry> reference_geometry(const dealii::DoFHandler<3, 3> &dof_handler)
{
  const dealii::FE_Q<3> trilinear(1);
  const dealii::QGauss<3> quadrature(2);
  dealii::FEValues<3> values(trilinear, quadrature, dealii::update_gradients | dealii::update_JxW_values);
  const dealii::Triangulation<3> &mesh = dof_handler.get_triangulation();
  std::vector<hexahedron::Geometry> result;
  result.reserve(mesh.n_active_cells());
  for (const auto &cell : mesh.active_cell_iterators())
  {
    values.reinit(cell);
    hexahedron::Geometry geometry;
    for (int point = 0; point < hexahedron::n_points; ++point)
    {
      const double volume = values.JxW(point);
      if (!(volume > 0))
        throw ParameterError("mesh: cell " + std::to_string(cell->active_cell_index()) +
                             " is turned inside out at one of its corners (volume " + std::to_string(volume) +
                             " m^3 at a quadrature point); repair the mesh");
      geometry.volume[point] = volume;
      for (int node = 0; node < hexahedron::n_nodes; ++node)
        for (int i = 0; i < 3; ++i)
          geometry.gradient[i][node][point] = values.shape_grad(node, point)[i];
    }
    geometry.share_volume = geometry.volume;
    geometry.volume_fraction = geometry.volume / sum(geometry.volume);
    result.push_back(geometry);
  }
  return result;
}

} // namespace bergamo::fe
