#include "fe_dealii/element/hexahedron.h"

namespace bergamo::fe::hexahedron
{

void elastic_stiffness(const MohrCoulomb &material, const Geometry &geometry, double *stiffness)
{
  for (int column = 0; column < n_dofs; ++column)
  {
    double unit[n_dofs] = {}, force[n_dofs];
    unit[column] = 1;
    Points unit_strain[6], stress[6];
    strain(geometry, unit, unit_strain);
    elastic_stress(material, unit_strain, stress);
    internal_force(geometry, stress, force);
    for (int row = 0; row < n_dofs; ++row)
      stiffness[n_dofs * row + column] = force[row];
  }
}

void lumped_mass(const double density, const Geometry &geometry, double (&mass)[n_nodes])
{
  for (int node = 0; node < n_nodes; ++node)
  {
    mass[node] = 0;
    for (int point = 0; point < n_points; ++point)
      mass[node] += density * shape_value(node, point) * geometry.share_volume[point];
  }
}

} // namespace bergamo::fe::hexahedron
