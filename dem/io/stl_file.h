#pragma once

#include "dem/io/triangle_soup.h"

namespace bergamo::dem
{

/// Triangles of an STL file, text or binary, by CGAL; places that are the same to the last bit are one node. The
/// normals of the file are not looked at: the order of the nodes says where the outside is, as the format demands.
/// Throws ConfigError for a file that is missing, empty, truncated or not to be understood.
TriangleSoup read_stl(const std::filesystem::path &path);

} // namespace bergamo::dem
