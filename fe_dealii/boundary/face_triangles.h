#pragma once

#include "dem/core/rows.h"
#include "fe_dealii/boundary/surface.h"

#include <array>
#include <span>
#include <vector>

namespace bergamo::fe
{

/// Linear triangles on faces of a body. Their corners are points of the faces, x = Σ N_i x_i over the nodes of a face,
/// and go wherever these go; forces on corners go to the nodes by the same N_i, so they do the same work, and have the
/// same sum and moment.
struct FaceTriangles
{
  struct Share
  {
    unsigned int node; ///< of the body
    double value;      ///< N_i
  };
  Rows<Share> corners;                                ///< by corner; shares add up to 1
  std::vector<std::array<unsigned int, 3>> triangles; ///< by corners, outward counterclockwise
};

/// Triangles over all faces of one surface or several, which are one where they share nodes.
/// @param n_squares along each side of a face, >= 1 (ConfigError): the degree of the surface makes its nodes the
/// corners, more follow faces that are curved or twisted, with triangles as fine
FaceTriangles divide_faces(std::span<const Surface> surfaces, unsigned int n_squares);

/// The same triangles with others on their back that turn away from them; both meet at the rim, if there is any. What
/// touches the one or the other moves the same nodes.
FaceTriangles both_sides(const FaceTriangles &front);

} // namespace bergamo::fe
