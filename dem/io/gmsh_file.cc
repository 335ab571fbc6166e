#include "dem/io/gmsh_file.h"

#ifdef BERGAMO_WITH_GMSH

#include "dem/geometry/cut_quadrilateral.h"

#include <gmsh.h>

#include <exception>
#include <string>
#include <unordered_map>

namespace bergamo::dem
{
namespace
{

constexpr int gmsh_triangle = 2, gmsh_quadrilateral = 3;

/// The library has one state for all.
class GmshSession
{
public:
  GmshSession()
  {
    constexpr bool reads_users_options = false;
    gmsh::initialize(0, nullptr, reads_users_options);
    gmsh::option::setNumber("General.Terminal", 0.);
  }
  ~GmshSession()
  {
    try
    {
      gmsh::finalize();
    }
    catch (...) // of no use to anybody
    {
    }
  }
  GmshSession(const GmshSession &) = delete;
};

TriangleSoup soup_of_model(const std::filesystem::path &path)
{
  std::vector<std::size_t> numbers;
  std::vector<double> places, ignored;
  gmsh::model::mesh::getNodes(numbers, places, ignored);
  TriangleSoup soup;
  std::unordered_map<std::size_t, std::int32_t> place_of;
  for (std::size_t n = 0; n < numbers.size(); ++n)
  {
    place_of.emplace(numbers[n], static_cast<std::int32_t>(n));
    soup.node.emplace_back(places[3 * n], places[3 * n + 1], places[3 * n + 2]);
  }
  std::vector<int> types;
  std::vector<std::vector<std::size_t>> elements, corners;
  constexpr int surfaces = 2;
  gmsh::model::mesh::getElements(types, elements, corners, surfaces);
  for (std::size_t k = 0; k < types.size(); ++k)
  {
    if (types[k] != gmsh_triangle && types[k] != gmsh_quadrilateral)
      reject_surface_file(path, "element ", elements[k][0], " is of Gmsh's type ", types[k],
                          ", neither a triangle of 3 nodes nor a quadrilateral of 4; mesh to the order 1");
    const std::size_t n_corners = types[k] == gmsh_triangle ? 3 : 4;
    for (std::size_t c = 0; c < corners[k].size(); c += n_corners)
    {
      const auto node = [&](const std::size_t i) { return place_of.at(corners[k][c + i]); };
      if (n_corners == 3)
        soup.triangle.push_back({node(0), node(1), node(2)});
      else
        add_quadrilateral({node(0), node(1), node(2), node(3)}, soup.node, soup.triangle);
    }
  }
  return soup;
}

} // namespace

TriangleSoup read_gmsh(const std::filesystem::path &path)
{
  // Gmsh looks at what a file holds, not at its name, and would run a script.
  const std::string content = surface_file_content(path);
  if (!content.starts_with("$MeshFormat") && !content.starts_with("$NOD"))
    reject_surface_file(path, "it begins with \"", content.substr(0, content.find_first_of(" \r\n")),
                        "\" instead of $MeshFormat, so it is no Gmsh mesh; save it by Gmsh as .msh");
  if (content.find(content[1] == 'N' ? "$ENDELM" : "$EndElements") == std::string::npos)
    reject_surface_file(path, "it has no $EndElements after ", content.size(),
                        " bytes: it is truncated; write it again");
  const GmshSession session;
  std::string reason;
  try
  {
    gmsh::open(path.string());
    return soup_of_model(path);
  }
  catch (const ConfigError &)
  {
    throw;
  }
  catch (const std::string &error) // of version 4.8
  {
    reason = error;
  }
  catch (const std::exception &error)
  {
    reason = error.what();
  }
  reject_surface_file(path, "Gmsh cannot read it (", reason, "); write it again");
}

} // namespace bergamo::dem

#else

namespace bergamo::dem
{

TriangleSoup read_gmsh(const std::filesystem::path &path)
{
  reject_surface_file(path, "this Bergamo was built without Gmsh; give an STL or VTU file, or install libgmsh-dev and "
                            "configure with -DBERGAMO_WITH_GMSH=ON");
}

} // namespace bergamo::dem

#endif
