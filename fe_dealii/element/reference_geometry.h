#pragma once

#include "fe_dealii/element/hexahedron.h"

#include <vector>

namespace dealii
{
template <int dim, int spacedim>
class DoFHandler;
}

namespace bergamo::fe
{

/// Geometry of every active cell, in the order of the cells; share 1. Throws ParameterError for a cell that is turned
/// inside out somewhere (a Jacobian determinant that is not positive).
std::vector<hexahedron::Geometry> reference_geometry(const dealii::DoFHandler<3, 3> &dof_handler);

} // namespace bergamo::fe
