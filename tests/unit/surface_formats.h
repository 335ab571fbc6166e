#pragma once

#include "tests/surfaces.h"

#include <zlib.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <span>
#include <sstream>
#include <string>
#include <vector>

/// Surfaces as other programs write them, put together here byte by byte.
namespace bergamo::dem::test
{

struct Soup
{
  std::vector<Vec3> node;
  std::vector<Triangle> triangle;
};

inline Soup soup_of(const Surface &surface)
{
  return {surface.node, surface.topology.triangle};
}

inline std::string text_of(const Vec3 &x)
{
  std::ostringstream text;
  text.precision(17);
  text << x[0] << ' ' << x[1] << ' ' << x[2];
  return text.str();
}

template <class Value>
void put(std::string &bytes, const Value value)
{
  bytes.append(reinterpret_cast<const char *>(&value), sizeof value);
}

inline std::string text_stl(const Soup &soup)
{
  std::string text = "solid a part\n";
  for (const Triangle &t : soup.triangle)
  {
    text += "  facet normal 0 0 0\n    outer loop\n";
    for (const std::int32_t n : t)
      text += "      vertex " + text_of(soup.node[n]) + "\n";
    text += "    endloop\n  endfacet\n";
  }
  return text + "endsolid a part\n";
}

/// @param title the first bytes; some programs begin with "solid"
inline std::string binary_stl(const Soup &soup, const std::string &title = "a part")
{
  std::string bytes = title + std::string(80 - title.size(), ' ');
  put(bytes, static_cast<std::uint32_t>(soup.triangle.size()));
  for (const Triangle &t : soup.triangle)
  {
    bytes.append(12, '\0');
    for (const std::int32_t n : t)
      for (int i = 0; i < 3; ++i)
        put(bytes, static_cast<float>(soup.node[n][i]));
    bytes.append(2, '\0');
  }
  return bytes;
}

/// With a line and a point beside the triangles.
inline std::string gmsh_2(const Soup &soup)
{
  std::ostringstream text;
  text << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n" << soup.node.size() << '\n';
  for (std::size_t n = 0; n < soup.node.size(); ++n)
    text << 10 + n << ' ' << text_of(soup.node[n]) << '\n';
  text << "$EndNodes\n$Elements\n" << soup.triangle.size() + 2 << "\n1 15 2 0 1 10\n2 1 2 0 1 10 11\n";
  for (std::size_t k = 0; k < soup.triangle.size(); ++k)
  {
    text << k + 3 << " 2 2 0 1";
    for (const std::int32_t n : soup.triangle[k])
      text << ' ' << 10 + n;
    text << '\n';
  }
  text << "$EndElements\n";
  return text.str();
}

inline std::string gmsh_4(const Soup &soup)
{
  const std::size_t n = soup.node.size(), m = soup.triangle.size();
  std::ostringstream text;
  text << "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 " << n << " 1 " << n << "\n2 1 0 " << n << '\n';
  for (std::size_t k = 0; k < n; ++k)
    text << k + 1 << '\n';
  for (const Vec3 &x : soup.node)
    text << text_of(x) << '\n';
  text << "$EndNodes\n$Elements\n1 " << m << " 1 " << m << "\n2 1 2 " << m << '\n';
  for (std::size_t k = 0; k < m; ++k)
  {
    text << k + 1;
    for (const std::int32_t node : soup.triangle[k])
      text << ' ' << node + 1;
    text << '\n';
  }
  text << "$EndElements\n";
  return text.str();
}

inline std::string base64(const std::string &bytes)
{
  constexpr const char *letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t k = 0; k < bytes.size(); k += 3)
  {
    const auto byte = [&](const std::size_t i)
    { return k + i < bytes.size() ? static_cast<unsigned char>(bytes[k + i]) : 0u; };
    const unsigned int three = byte(0) << 16 | byte(1) << 8 | byte(2);
    for (int i = 0; i < 4; ++i)
      text += k + i <= bytes.size() ? letters[three >> (18 - 6 * i) & 63] : '=';
  }
  return text;
}

/// How a VTU file holds its numbers.
struct VtuForm
{
  enum class Place
  {
    text,
    base64,
    appended_base64,
    appended_raw
  };
  Place place = Place::text;
  bool is_packed = false;      ///< by zlib
  bool has_long_words = false; ///< sizes of 8 bytes
  std::size_t block = 48;      ///< of zlib [bytes]
};

/// Cells of any kind, for the text of a VTU file.
struct VtuCells
{
  std::vector<std::vector<std::int32_t>> corners;
  std::vector<std::uint8_t> type;
};

inline VtuCells triangles_of(const Soup &soup)
{
  VtuCells cells;
  for (const Triangle &t : soup.triangle)
  {
    cells.corners.emplace_back(t.begin(), t.end());
    cells.type.push_back(5);
  }
  return cells;
}

class VtuText
{
public:
  VtuText(const std::vector<Vec3> &node, const VtuCells &cells, const VtuForm &form) : form(form)
  {
    std::vector<double> places;
    for (const Vec3 &x : node)
      places.insert(places.end(), {x[0], x[1], x[2]});
    std::vector<std::int64_t> corners, ends;
    for (const auto &cell : cells.corners)
    {
      corners.insert(corners.end(), cell.begin(), cell.end());
      ends.push_back(static_cast<std::int64_t>(corners.size()));
    }
    std::ostringstream head;
    head << "<?xml version=\"1.0\"?>\n<!-- a comment -->\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" "
            "byte_order=\"LittleEndian\"";
    if (form.has_long_words)
      head << " header_type=\"UInt64\"";
    if (form.is_packed)
      head << " compressor=\"vtkZLibDataCompressor\"";
    head << ">\n<UnstructuredGrid>\n<Piece NumberOfPoints=\"" << node.size() << "\" NumberOfCells=\""
         << cells.type.size() << "\">\n<Points>\n";
    text = head.str();
    add<double>("Float64", "Points", places);
    text += "</Points>\n<Cells>\n";
    add<std::int64_t>("Int64", "connectivity", corners);
    add<std::int64_t>("Int64", "offsets", ends);
    add<std::uint8_t>("UInt8", "types", cells.type);
    text += "</Cells>\n</Piece>\n</UnstructuredGrid>\n";
    if (is_appended())
      text += std::string("<AppendedData encoding=\"") +
              (form.place == VtuForm::Place::appended_raw ? "raw" : "base64") + "\">\n   _" + appended +
              "\n</AppendedData>\n";
    text += "</VTKFile>\n";
  }

  std::string text;

private:
  bool is_appended() const { return form.place >= VtuForm::Place::appended_base64; }

  void put_word(std::string &bytes, const std::size_t value) const
  {
    if (form.has_long_words)
      put(bytes, static_cast<std::uint64_t>(value));
    else
      put(bytes, static_cast<std::uint32_t>(value));
  }

  /// What stands in the file of an array; base64 of the head and of packed data are two pieces.
  std::string stored(const std::string &bytes) const
  {
    std::string head, data = bytes;
    if (!form.is_packed)
      put_word(head, bytes.size());
    else
    {
      data.clear();
      std::vector<std::size_t> sizes;
      for (std::size_t at = 0; at < bytes.size(); at += form.block)
      {
        const std::string block = bytes.substr(at, form.block);
        uLongf size = compressBound(block.size());
        std::string packed(size, '\0');
        compress(reinterpret_cast<Bytef *>(packed.data()), &size, reinterpret_cast<const Bytef *>(block.data()),
                 block.size());
        data += packed.substr(0, size);
        sizes.push_back(size);
      }
      put_word(head, sizes.size());
      put_word(head, form.block);
      put_word(head, bytes.size() % form.block);
      for (const std::size_t size : sizes)
        put_word(head, size);
    }
    if (form.place == VtuForm::Place::appended_raw)
      return head + data;
    return form.is_packed ? base64(head) + base64(data) : base64(head + data);
  }

  template <class Value>
  void add(const std::string &type, const std::string &name, const std::vector<Value> &values)
  {
    text += "<DataArray type=\"" + type + "\" Name=\"" + name + "\"";
    if (name == "Points")
      text += " NumberOfComponents=\"3\"";
    const std::string bytes(reinterpret_cast<const char *>(values.data()), values.size() * sizeof(Value));
    if (is_appended())
    {
      text += " format=\"appended\" offset=\"" + std::to_string(appended.size()) + "\"/>\n";
      appended += stored(bytes);
    }
    else if (form.place == VtuForm::Place::base64)
      text += " format=\"binary\">\n  " + stored(bytes) + "\n</DataArray>\n";
    else
    {
      std::ostringstream numbers;
      numbers.precision(17);
      for (const Value value : values)
        numbers << +value << ' ';
      text += " format=\"ascii\">\n" + numbers.str() + "\n</DataArray>\n";
    }
  }

  VtuForm form;
  std::string appended;
};

inline std::string vtu(const Soup &soup, const VtuForm &form = {})
{
  return VtuText(soup.node, triangles_of(soup), form).text;
}

} // namespace bergamo::dem::test
