#include "fe_dealii/mesh/mesh_file.h"

#include "dem/core/error.h"
#include "fe_dealii/mesh/mesh_check.h"

#include <deal.II/grid/grid_in.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/tria.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>
#include <sstream>

namespace bergamo::fe
{
namespace
{

template <class... Parts>
[[noreturn]] void reject(const std::filesystem::path &path, const Parts &...parts)
{
  bergamo::reject("mesh file ", path.string(), ": ", parts...);
}

enum class Format
{
  gmsh,
  ucd
};

Format format_of(const std::filesystem::path &path)
{
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](const unsigned char c) { return std::tolower(c); });
  if (extension == ".msh")
    return Format::gmsh;
  if (extension == ".inp" || extension == ".ucd")
    return Format::ucd;
  reject(path, "the extension \"", extension, "\" is not known; give a mesh of Gmsh (.msh) or UCD (.inp, .ucd)");
}

/// What deal.II takes for granted and would misread.
void check_start(const std::filesystem::path &path, const Format format, std::istream &file)
{
  std::string word;
  file >> word;
  if (word.empty())
    reject(path, "the file is empty; write the mesh again");
  if (format == Format::ucd && word[0] == '*')
    reject(path, "it begins with \"", word, "\", which is Abaqus' format; export it as UCD or as Gmsh .msh");
  if (format == Format::gmsh && word == "$MeshFormat")
  {
    double version = 0;
    int binary = 1;
    file >> version >> binary;
    if (!file || !(version >= 2 && version < 4.2))
      reject(path, "version ", version, " of Gmsh's format cannot be read; save it as version 2 or 4.1");
    if (binary != 0)
      reject(path, "the file is binary; save it as text (gmsh -format msh41 -save, without -bin)");
  }
  else if (format == Format::gmsh && word != "$NOD")
    reject(path, "it begins with \"", word,
           "\" instead of $MeshFormat, so it is no Gmsh mesh; save it by Gmsh as .msh");
  file.clear();
  file.seekg(0);
}

/// The reason alone, on one line: deal.II frames it by a page of its own.
std::string reason_of(const std::exception &error)
{
  std::ostringstream text;
  if (const auto *const of_dealii = dynamic_cast<const dealii::ExceptionBase *>(&error))
    of_dealii->print_info(text);
  else
    text << error.what();
  std::istringstream words(text.str());
  std::string line, word;
  while (words >> word)
    line += (line.empty() ? "" : " ") + word;
  return line.empty() ? "no reason given" : line;
}

} // namespace

void read_mesh(const std::filesystem::path &path, dealii::Triangulation<3, 3> &triangulation, const double unit)
{
  const Format format = format_of(path);
  if (!(unit > 0) || !std::isfinite(unit))
    reject(path, "its unit = ", unit, " m is not allowed; give a positive number, 0.001 for millimetres");
  if (triangulation.n_levels() != 0)
    reject(path, "the triangulation already holds ", triangulation.n_active_cells(),
           " cells; pass an empty one or call clear() first");
  std::ifstream file(path);
  if (!file || std::filesystem::is_directory(path))
    reject(path, "no such file to be read; check its name and its permissions");
  check_start(path, format, file);

  dealii::GridIn<3> reader(triangulation);
  try
  {
    if (format == Format::gmsh)
      reader.read_msh(file);
    else
      reader.read_ucd(file);
  }
  catch (const std::exception &error)
  {
    reject(path, "the mesh cannot be read (", reason_of(error),
           "); it must be whole and hold hexahedra of 8 nodes, and quadrilaterals only on its surface");
  }
  if (unit != 1)
    dealii::GridTools::scale(unit, triangulation);
  try
  {
    check_mesh(triangulation);
  }
  catch (const ConfigError &error)
  {
    triangulation.clear();
    throw ConfigError(path.string() + ": " + error.what());
  }
}

} // namespace bergamo::fe
