#pragma once

#include "dem/core/error.h"
#include "dem/core/types.h"
#include "dem/geometry/surface_topology.h"

#include <filesystem>
#include <string>
#include <vector>

namespace bergamo::dem
{

/// Triangles as a file lists them, before anybody has looked whether they make a surface.
struct TriangleSoup
{
  std::vector<Vec3> node;         ///< places in the unit of the file
  std::vector<Triangle> triangle; ///< nodes that are there
};

/// Throws ConfigError with the file's name before the parts.
template <class... Parts>
[[noreturn]] void reject_surface_file(const std::filesystem::path &path, const Parts &...parts)
{
  reject("surface file ", path.string(), ": ", parts...);
}

/// All bytes of a file. Throws ConfigError for one that is missing, not to be read, or empty.
std::string surface_file_content(const std::filesystem::path &path);

/// "(x, y, z)".
std::string place_text(const Vec3 &place);

} // namespace bergamo::dem
