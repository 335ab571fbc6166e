#pragma once

#include <filesystem>

namespace dealii
{
template <int dim, int spacedim>
class Triangulation;
}

namespace bergamo::fe
{

/// Fills the empty `triangulation` with the hexahedra of a file, as written by Gmsh (.msh, text, versions 1, 2, 4.0 and
/// 4.1) or AVS UCD (.inp, .ucd). Faces that the file lists keep their number as boundary id: physical surfaces of Gmsh,
/// materials of UCD's quadrilaterals; all others have the id 0. Cells keep theirs as material id: physical volumes of
/// Gmsh, materials of UCD's hexahedra. Curved cells become hexahedra with straight edges.
/// @param unit of the file's coordinates [m], e.g. 0.001 for a mesh drawn in millimetres
/// Throws ConfigError, with the file's name, for a file that is missing, of another format or not to be understood,
/// a unit that is not positive, a triangulation that is not empty, or a mesh that check_mesh() refuses; the
/// triangulation is then empty.
void read_mesh(const std::filesystem::path &path, dealii::Triangulation<3, 3> &triangulation, double unit = 1);

} // namespace bergamo::fe
