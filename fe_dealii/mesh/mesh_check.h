#pragma once

namespace dealii
{
template <int dim, int spacedim>
class Triangulation;
}

namespace bergamo::fe
{

/// Looks for what a mesh from elsewhere may suffer from. Throws ConfigError, with the place, for
/// - cells that are no hexahedra, or no cells at all;
/// - cells turned inside out or flat at a corner;
/// - vertices closer than a thousandth of the shortest edge that are not joined: a seam that parts the body;
/// - pieces that share no face. An edge or a corner alone is a hinge that no solid has.
void check_mesh(const dealii::Triangulation<3, 3> &triangulation);

} // namespace bergamo::fe
