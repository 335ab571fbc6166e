#pragma once

#include "dem/io/triangle_soup.h"

namespace bergamo::dem
{

/// Triangles and quadrilaterals, cut in two, of a mesh of Gmsh (.msh, text or binary, of any version that the library
/// reads: 1, 2 and 4), in the order of the file's surfaces. Other elements are left out.
/// Throws ConfigError for a file that is missing, empty, truncated or not to be understood, has curved elements or no
/// triangles; and for any file where Bergamo was built without Gmsh.
TriangleSoup read_gmsh(const std::filesystem::path &path);

} // namespace bergamo::dem
