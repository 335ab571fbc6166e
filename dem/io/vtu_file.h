#pragma once

#include "dem/io/triangle_soup.h"

namespace bergamo::dem
{

/// Triangles and quadrilaterals, cut in two, of an unstructured grid of VTK (.vtu), piece after piece; see VtkXmlFile
/// for the forms of its data. Points and lines are left out.
/// Throws ConfigError for a file that is missing, empty, truncated, damaged or of another kind, or with other cells.
TriangleSoup read_vtu(const std::filesystem::path &path);

} // namespace bergamo::dem
