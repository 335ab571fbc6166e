#include "dem/io/vtu_writer.h"

#include "dem/core/parallel.h"
#include "dem/core/whole_file.h"
#include "dem/core/xml.h"

#include <algorithm>
#include <cstdint>

namespace bergamo::dem
{
namespace
{

std::size_t size_of(const VtuArray &array)
{
  return array.n_parts * array.bytes_per_part;
}

/// Section of the XML part; `offset` runs on through the binary part.
std::string section(const std::string &name, const std::vector<VtuArray> &arrays, std::size_t &offset)
{
  std::string text = "      <" + name + ">\n";
  for (const VtuArray &array : arrays)
  {
    text +=
        "        <DataArray " + array.attributes + " format=\"appended\" offset=\"" + std::to_string(offset) + "\"/>\n";
    offset += sizeof(std::uint64_t) + size_of(array);
  }
  return text + "      </" + name + ">\n";
}

void write(WholeFile &file, const VtuArray &array)
{
  const std::uint64_t size = size_of(array);
  file.write(&size, sizeof size);
  constexpr std::size_t parts_at_once = 2048;
  std::vector<std::byte> block;
  for (std::size_t first = 0; first < array.n_parts; first += parts_at_once)
  {
    const std::size_t n = std::min(parts_at_once, array.n_parts - first);
    block.resize(n * array.bytes_per_part);
    parallel_for(n, [&](const std::size_t i) { array.fill(first + i, block.data() + i * array.bytes_per_part); });
    file.write(block.data(), block.size());
  }
}

} // namespace

std::string vtu_attributes(const std::string &type, const std::string &name, const int n_components)
{
  return "type=\"" + type + "\" Name=\"" + xml_escaped(name) + "\" NumberOfComponents=\"" +
         std::to_string(n_components) + "\"";
}

void write_vtu(const VtuGrid &grid, const std::filesystem::path &path)
{
  const std::vector<VtuArray> points{grid.points};
  std::size_t offset = 0;
  std::string head = "<?xml version=\"1.0\"?>\n"
                     "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
                     "header_type=\"UInt64\">\n"
                     "  <UnstructuredGrid>\n"
                     "    <Piece NumberOfPoints=\"" +
                     std::to_string(grid.n_points) + "\" NumberOfCells=\"" + std::to_string(grid.n_cells) + "\">\n";
  head += section("Points", points, offset);
  head += section("Cells", grid.cells, offset);
  if (!grid.point_data.empty())
    head += section("PointData", grid.point_data, offset);
  head += section("CellData", grid.cell_data, offset);
  head += "    </Piece>\n  </UnstructuredGrid>\n  <AppendedData encoding=\"raw\">\n_";

  WholeFile file(path);
  file.write(head);
  for (const std::vector<VtuArray> *arrays : {&points, &grid.cells, &grid.point_data, &grid.cell_data})
    for (const VtuArray &array : *arrays)
      write(file, array);
  file.write("\n  </AppendedData>\n</VTKFile>\n");
  file.commit();
}

} // namespace bergamo::dem
