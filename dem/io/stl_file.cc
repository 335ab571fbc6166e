#include "dem/io/stl_file.h"

#include <CGAL/IO/STL.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <sstream>
#include <string_view>

namespace bergamo::dem
{
namespace
{

constexpr std::size_t head_size = 84, triangle_size = 50; // of a binary file [bytes]
constexpr std::string_view spaces = " \t\r\n\v\f";

std::uint32_t announced_triangles(const std::string &content)
{
  std::uint32_t n = 0;
  if (content.size() >= head_size)
    std::memcpy(&n, content.data() + head_size - sizeof n, sizeof n);
  return n;
}

bool begins_as_text(const std::string &content)
{
  const std::size_t start = content.find_first_not_of(spaces);
  return start != std::string::npos && content.compare(start, 5, "solid") == 0;
}

/// CGAL would take a file that ends early for an empty one, and may go on from one format to the other.
void check_text(const std::filesystem::path &path, const std::string &content)
{
  const std::size_t last = content.rfind("endsolid");
  if (last == std::string::npos || content.find("facet", last + 8) != std::string::npos)
    reject_surface_file(path, "it begins with \"solid\" but has no \"endsolid\" at its end after ", content.size(),
                        " bytes: it is truncated; write it again");
}

/// A place that is no number would be taken for some other one: CGAL sorts places.
void check_binary(const std::filesystem::path &path, const std::string &content)
{
  if (content.size() < head_size)
    reject_surface_file(path, "it has ", content.size(), " bytes and does not begin with \"solid\": it is no STL file");
  const std::size_t n = announced_triangles(content), needed = head_size + n * triangle_size;
  if (content.size() < needed)
    reject_surface_file(path, "it has ", content.size(), " bytes, but the ", n, " triangles that it announces need ",
                        needed, ": it is truncated or no STL file; write it again");
  for (std::size_t t = 0; t < n; ++t)
  {
    std::array<float, 9> places;
    std::memcpy(places.data(), content.data() + head_size + t * triangle_size + 3 * sizeof(float), sizeof places);
    if (!std::all_of(places.begin(), places.end(), [](const float x) { return std::isfinite(x); }))
      reject_surface_file(path, "triangle ", t, " has a place that is not finite; write it again");
  }
}

} // namespace

TriangleSoup read_stl(const std::filesystem::path &path)
{
  std::string content = surface_file_content(path);
  // Programs begin binary files with "solid", too: what counts is the size.
  const bool is_binary =
      content.size() == head_size + announced_triangles(content) * triangle_size || !begins_as_text(content);
  if (is_binary)
    check_binary(path, content);
  else
    check_text(path, content);

  std::istringstream stream(std::move(content));
  std::vector<std::array<double, 3>> places;
  std::vector<std::array<int, 3>> triangles;
  if (!CGAL::IO::read_STL(stream, places, triangles))
    reject_surface_file(path, "it is no ", is_binary ? "binary" : "text", " STL file that can be understood: after ",
                        triangles.size(), " triangles something is no facet of three vertices; write it again");
  TriangleSoup soup;
  for (const std::array<double, 3> &place : places)
    soup.node.emplace_back(place[0], place[1], place[2]);
  soup.triangle.assign(triangles.begin(), triangles.end());
  return soup;
}

} // namespace bergamo::dem
