#include "dem/io/surface_file.h"

#include "dem/geometry/closed_surface.h"
#include "dem/geometry/merge_nodes.h"
#include "dem/geometry/surface_size.h"
#include "dem/io/gmsh_file.h"
#include "dem/io/stl_file.h"
#include "dem/io/vtu_file.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <utility>

namespace bergamo::dem
{
namespace
{

TriangleSoup read_soup(const std::filesystem::path &path)
{
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](const unsigned char c) { return std::tolower(c); });
  if (extension == ".stl")
    return read_stl(path);
  if (extension == ".msh")
    return read_gmsh(path);
  if (extension == ".vtu")
    return read_vtu(path);
  reject_surface_file(path, "the extension \"", extension,
                      "\" is not known; give an STL file (.stl), a mesh of Gmsh (.msh) or of VTK (.vtu)");
}

/// Number and middle of a triangle, for messages.
std::string triangle_text(const std::vector<Vec3> &node, const Triangle &t, const std::size_t number)
{
  return "triangle " + std::to_string(number) + " around " + place_text((node[t[0]] + node[t[1]] + node[t[2]]) / 3.) +
         " m";
}

/// Makes neighbours share nodes.
void join(TriangleSoup &soup, const double tolerance)
{
  const std::vector<Vec3> node = soup.node;
  const std::vector<Triangle> triangle = soup.triangle;
  const double distance = tolerance * extent_of(node);
  if (!(distance > 0.))
    reject("all nodes lie at ", place_text(node.front()), " m; write the surface again");
  merge_nodes(soup.node, soup.triangle, distance);
  for (std::size_t k = 0; k < triangle.size(); ++k)
  {
    const auto [a, b, c] = soup.triangle[k];
    if (a == b || b == c || c == a)
      reject(triangle_text(node, triangle[k], k), " has no area: two of its nodes are not farther apart than ",
             distance,
             " m, the tolerance for nodes to become one; remove it and let its neighbours meet, or make the "
             "tolerance smaller");
  }
}

void check_use(const SurfaceView &surface, const SurfaceUse use)
{
  if (use == SurfaceUse::sheet)
    return;
  if (const Holes holes = holes_of(surface.topology); holes.n_edges > 0)
  {
    const SurfaceTopology::Edge &e = surface.topology.edge[holes.edge];
    reject("it has ", holes.n_holes, holes.n_holes == 1 ? " hole" : " holes", " with ", holes.n_edges,
           " open edges, one of them of triangle ", e.left, " around ",
           place_text(0.5 * (surface.node[e.from] + surface.node[e.to])),
           " m, but a closed surface is wanted; add the triangles that are missing, or raise the merge tolerance where "
           "nodes do not meet");
  }
  const double volume = enclosed_moments(surface, surface.node.front())[0];
  if (use == SurfaceUse::body && !(volume > 0.))
    reject("it encloses ", volume, " m3: its normals point inwards, but grains are to be outside; read it with flip");
  if (use == SurfaceUse::vessel && !(volume < 0.))
    reject("it encloses ", volume, " m3: its normals point outwards, but grains are to be inside; read it with flip");
}

Surface surface_of(TriangleSoup soup, const SurfaceFileParameters &parameters)
{
  for (std::size_t n = 0; n < soup.node.size(); ++n)
  {
    soup.node[n] *= parameters.unit;
    if (!soup.node[n].allFinite())
      reject("node ", n, " lies at ", place_text(soup.node[n]), " m, which is not finite; write it again");
  }
  if (soup.triangle.empty())
    reject("it holds no triangles; write the surface, not its lines or points");
  join(soup, parameters.merge_tolerance);
  if (parameters.flip)
    for (Triangle &t : soup.triangle)
      std::swap(t[1], t[2]);
  try
  {
    Surface surface(soup.node, soup.triangle);
    surface.validate(surface.material + 1);
    check_use(surface.view(), parameters.use);
    return surface;
  }
  catch (const TriangleError &error)
  {
    reject(error.what(), "; ", triangle_text(soup.node, soup.triangle[error.triangle], error.triangle));
  }
}

} // namespace

Surface read_surface(const std::filesystem::path &path, const SurfaceFileParameters &parameters)
{
  if (!(parameters.unit > 0.) || !std::isfinite(parameters.unit))
    reject_surface_file(path, "its unit = ", parameters.unit,
                        " m is not allowed; give a positive number, 0.001 for millimetres");
  if (!(parameters.merge_tolerance >= 1e-12 && parameters.merge_tolerance <= 1e-2))
    reject_surface_file(path, "the merge tolerance ", parameters.merge_tolerance,
                        " is not allowed; give a share of the surface's longest side in [1e-12, 1e-2]");
  TriangleSoup soup = read_soup(path);
  try
  {
    return surface_of(std::move(soup), parameters);
  }
  catch (const ConfigError &error)
  {
    reject_surface_file(path, error.what());
  }
}

} // namespace bergamo::dem
