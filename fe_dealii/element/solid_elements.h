#pragma once

#include "fe_dealii/element/element_group.h"
#include "fe_dealii/material/initial_stress.h"
#include "fe_dealii/material/material.h"

#include <memory>

namespace dealii
{
template <int dim, int spacedim>
class DoFHandler;
}

namespace bergamo::fe
{

/// Which strains hexahedra of 8 nodes have.
enum class Strains
{
  mean_dilatation, ///< of the nodes' displacements, the dilatation at its mean: cheap, stiff or soft in bending
  enhanced         ///< with inner modes of each element, which let a single one over the thickness bend
};

/// The elements of a solid body on all active cells, in their order.
/// @param dof_handler of an FESystem(FE_Q(degree), 3) of degree 1 or 2: hexahedra of 8 or 27 nodes
/// @param initial_stress at the points; empty for a law of large strain
/// @param strains of elements of 8 nodes; those of 27 have but one kind
/// @throws ConfigError for a cell that is turned inside out somewhere (a Jacobian determinant that is not positive),
///         for an initial stress that is not finite or beyond the yield surface, and for one in a law of large strain
std::unique_ptr<ElementGroup> make_solid_elements(const dealii::DoFHandler<3, 3> &dof_handler, const Material &material,
                                                  const InitialStress &initial_stress,
                                                  Strains strains = Strains::mean_dilatation);

} // namespace bergamo::fe
