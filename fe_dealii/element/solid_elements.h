#pragma once

#include "fe_dealii/element/element_group.h"
#include "fe_dealii/material/material.h"

#include <memory>

namespace dealii
{
template <int dim, int spacedim>
class DoFHandler;
}

namespace bergamo::fe
{

/// The elements of a solid body on all active cells, in their order.
/// @param dof_handler of an FESystem(FE_Q(degree), 3) of degree 1 or 2: hexahedra of 8 or 27 nodes
/// @param initial_pressure of the uniform initial stress −p0 I; 0 for a law of large strain [Pa]
/// @throws ParameterError for a cell that is turned inside out somewhere (a Jacobian determinant that is not positive)
///         and for an initial pressure in a law of large strain
std::unique_ptr<ElementGroup> make_solid_elements(const dealii::DoFHandler<3, 3> &dof_handler, const Material &material,
                                                  double initial_pressure);

} // namespace bergamo::fe
