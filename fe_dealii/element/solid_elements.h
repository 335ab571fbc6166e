#pragma once

#include "fe_dealii/element/element_group.h"
#include "fe_dealii/material/initial_stress.h"
#include "fe_dealii/material/material.h"

#include <memory>
#include <optional>

namespace dealii
{
template <int dim, int spacedim>
class DoFHandler;
}

namespace bergamo::fe
{

/// What hexahedra of 8 nodes do with what their nodes move beyond a linear displacement.
enum class Hourglass
{
  at_points, ///< strains of the trilinear displacement at eight points, the dilatation at its mean: no bending
  bending    ///< a stiffness of its own, with which one element over a thickness bends: see bending_hexahedron.h
};

/// What laws of small strain take as the strain of an increment. Laws of large strain have their own.
enum class Kinematics
{
  small_strain, ///< of the shape in the reference configuration: forces are nominal, and a rotation strains
  large_strain  ///< of the present shape, in rate form: see large_strain_hexahedra.h
};

struct SolidKind
{
  Hourglass hourglass = Hourglass::at_points; ///< of elements of 8 nodes; those of 27 bend anyway
  Kinematics kinematics = Kinematics::small_strain;
};

/// The elements of a solid body on its active cells, in their order.
/// @param dof_handler of an FESystem(FE_Q(degree), 3) of degree 1 or 2: hexahedra of 8 or 27 nodes
/// @param initial_stress at the points; empty for a law of large strain
/// @param material_id of the cells to take; none: all
/// @throws ConfigError for a cell that is turned inside out somewhere (a Jacobian determinant that is not positive),
///         for an initial stress that is not finite or beyond the yield surface, and for one in a law of large strain;
///         for large strain of a law of small strain in elements that bend or have 27 nodes
std::unique_ptr<ElementGroup> make_solid_elements(const dealii::DoFHandler<3, 3> &dof_handler, const Material &material,
                                                  const InitialStress &initial_stress, const SolidKind &kind = {},
                                                  std::optional<unsigned int> material_id = {});

} // namespace bergamo::fe
