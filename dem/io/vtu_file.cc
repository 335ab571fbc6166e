#include "dem/io/vtu_file.h"

#include "dem/geometry/cut_quadrilateral.h"
#include "dem/io/vtk_cell.h"
#include "dem/io/vtk_xml_file.h"

#include <algorithm>
#include <array>
#include <string>

namespace bergamo::dem
{
namespace
{

/// One piece of the grid.
class Piece
{
public:
  Piece(const std::filesystem::path &path, const VtkXmlFile &file, const VtkXmlFile::Element &piece)
      : path(path), file(file), piece(piece)
  {
  }

  void add_to(TriangleSoup &soup) const
  {
    const std::size_t n_points = file.count(piece, "NumberOfPoints"), n_cells = file.count(piece, "NumberOfCells");
    const std::vector<double> places = array("Points", "", 3 * n_points);
    const std::vector<double> ends = array("Cells", "offsets", n_cells), types = array("Cells", "types", n_cells);
    const auto n_corners = n_cells > 0 && ends.back() > 0. ? static_cast<std::size_t>(ends.back()) : 0;
    const std::vector<double> corners = array("Cells", "connectivity", n_corners);

    const auto first_node = static_cast<std::int32_t>(soup.node.size());
    for (std::size_t n = 0; n < n_points; ++n)
      soup.node.emplace_back(places[3 * n], places[3 * n + 1], places[3 * n + 2]);
    std::size_t at = 0;
    for (std::size_t c = 0; c < n_cells; ++c)
    {
      if (!(ends[c] >= static_cast<double>(at) && ends[c] <= static_cast<double>(n_corners)))
        reject_surface_file(path, "cell ", c, " ends at ", ends[c], " of ", n_corners, " corners; write it again");
      const auto end = static_cast<std::size_t>(ends[c]), n = end - at;
      std::array<std::int32_t, 4> node{};
      for (std::size_t k = 0; k < std::min(n, node.size()); ++k)
      {
        const double point = corners[at + k];
        if (!(point >= 0. && point < static_cast<double>(n_points)))
          reject_surface_file(path, "cell ", c, " names point ", point, ", but there are the points 0 to ", n_points,
                              " - 1; write it again");
        node[k] = first_node + static_cast<std::int32_t>(point);
      }
      at = end;
      if (types[c] == vtk_triangle && n == 3)
        soup.triangle.push_back({node[0], node[1], node[2]});
      else if (types[c] == vtk_quadrilateral && n == 4)
        add_quadrilateral(node, soup.node, soup.triangle);
      else if (!is_point_or_line(types[c]))
        reject_surface_file(path, "cell ", c, " is of VTK's type ", types[c], " with ", n,
                            " corners, neither a triangle nor a quadrilateral; in ParaView, apply \"Extract Surface\", "
                            "\"Triangulate\" and \"Append Datasets\" before saving");
    }
  }

private:
  /// The numbers of a DataArray of a section, by its name or the only one.
  std::vector<double> array(const std::string &section, const std::string &name, const std::size_t n_expected) const
  {
    const std::string text = name.empty() ? section : name;
    if (const auto arrays = piece.get_child_optional(section))
      for (const auto &[tag, element] : *arrays)
        if (tag == "DataArray" && (name.empty() || element.get("<xmlattr>.Name", "") == name))
        {
          std::vector<double> numbers = file.numbers(element);
          if (numbers.size() != n_expected)
            reject_surface_file(path, "its array ", text, " has ", numbers.size(), " numbers instead of ", n_expected,
                                "; write it again");
          return numbers;
        }
    reject_surface_file(path, "it has no array ", text, "; write it again");
  }

  const std::filesystem::path &path;
  const VtkXmlFile &file;
  const VtkXmlFile::Element &piece;
};

} // namespace

TriangleSoup read_vtu(const std::filesystem::path &path)
{
  const VtkXmlFile file(path, "UnstructuredGrid");
  TriangleSoup soup;
  for (const auto &[tag, element] : file.data_set())
    if (tag == "Piece")
      Piece(path, file, element).add_to(soup);
  return soup;
}

} // namespace bergamo::dem
