#include "dem/core/error.h"
#include "dem/geometry/closed_surface.h"
#include "dem/geometry/surface_size.h"
#include "dem/io/surface_file.h"

#include "tests/temporary_folder.h"
#include "tests/unit/surface_formats.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

using namespace bergamo;
using namespace bergamo::dem;
using namespace bergamo::dem::test;
using Catch::Contains;

namespace
{

#ifdef BERGAMO_WITH_GMSH
constexpr bool reads_gmsh = true;
#else
constexpr bool reads_gmsh = false;
#endif

/// Writes bytes and reads them as a surface.
dem::Surface read(const TemporaryFolder &folder, const std::string &name, const std::string &bytes,
                  const SurfaceFileParameters &parameters = {})
{
  ::put(folder / name, bytes);
  return read_surface(folder / name, parameters);
}

/// What is wrong with them, as the user reads it; the file is named in every case.
std::string refusal(const std::string &name, const std::string &bytes, const SurfaceFileParameters &parameters = {})
{
  const TemporaryFolder folder;
  try
  {
    read(folder, name, bytes, parameters);
  }
  catch (const ConfigError &error)
  {
    const std::string message = error.what();
    CHECK_THAT(message, Contains("surface file " + (folder / name).string() + ": "));
    return message;
  }
  return "nothing was refused";
}

/// Corners of the triangles, in order.
std::vector<Vec3> corners_of(const std::vector<Vec3> &node, const std::vector<Triangle> &triangles)
{
  std::vector<Vec3> corners;
  for (const Triangle &t : triangles)
    for (const std::int32_t n : t)
      corners.push_back(node[n]);
  return corners;
}

void check_is(const dem::Surface &surface, const Soup &soup, const double tolerance = 0.)
{
  REQUIRE(surface.topology.n_faces() == soup.triangle.size());
  CHECK(surface.topology.n_nodes() == soup.node.size());
  const auto found = corners_of(surface.node, surface.topology.triangle), given = corners_of(soup.node, soup.triangle);
  double farthest = 0.;
  for (std::size_t k = 0; k < given.size(); ++k)
    farthest = std::max(farthest, (found[k] - given[k]).norm());
  CHECK(farthest <= tolerance);
}

/// The cube away from the origin, with places that floats and six digits hold.
Soup shifted_cube()
{
  Soup soup = soup_of(cube());
  for (Vec3 &x : soup.node)
    x = Vec3(2., 3., 4.).cwiseProduct(x) + Vec3(0.5, -7., 100.);
  return soup;
}

std::vector<std::pair<std::string, std::string>> all_formats(const Soup &soup)
{
  using Place = VtuForm::Place;
  std::vector<std::pair<std::string, std::string>> files{{"text.stl", text_stl(soup)},
                                                         {"binary.STL", binary_stl(soup)},
                                                         {"solid.stl", binary_stl(soup, "solid of another program")}};
  if (reads_gmsh)
  {
    files.emplace_back("version2.msh", gmsh_2(soup));
    files.emplace_back("version4.msh", gmsh_4(soup));
  }
  for (const Place place : {Place::text, Place::base64, Place::appended_base64, Place::appended_raw})
    for (const bool is_packed : {false, true})
      for (const bool has_long_words : {false, true})
        if (place != Place::text || !is_packed)
          for (const std::size_t block : {std::size_t(48), std::size_t(40), std::size_t(32768)})
            files.emplace_back("grid" + std::to_string(files.size()) + ".vtu",
                               vtu(soup, {place, is_packed, has_long_words, block}));
  return files;
}

} // namespace

TEST_CASE("the same cube comes from all formats")
{
  const TemporaryFolder folder;
  const Soup soup = shifted_cube();
  for (const auto &[name, bytes] : all_formats(soup))
  {
    INFO(name << ":\n" << bytes.substr(0, 400));
    const dem::Surface surface = read(folder, name, bytes, {.use = SurfaceUse::body});
    check_is(surface, soup);
    CHECK(surface.topology.n_edges() == 18);
    CHECK(surface.topology.is_closed());
    CHECK(surface.is_at_rest());
    CHECK(enclosed_body(surface.view()).volume == Approx(8. * 24.));
  }
}

TEST_CASE("triangles keep the order of the file, and a surface may be open")
{
  std::mt19937_64 random(3);
  const Soup soup = soup_of(grid_surface(
      9, [](const double x, const double y) { return std::sin(x) * std::cos(y); }, 0.2, random));
  const TemporaryFolder folder;
  for (const auto &[name, bytes] : all_formats(soup))
  {
    INFO(name);
    const bool is_of_floats = name == "binary.STL" || name == "solid.stl";
    check_is(read(folder, name, bytes), soup, is_of_floats ? 1e-6 : 0.);
  }
}

TEST_CASE("places are in the unit of the file, and normals turn where asked")
{
  const TemporaryFolder folder;
  Soup soup = shifted_cube();
  const std::string bytes = text_stl(soup);
  const dem::Surface small = read(folder, "a.stl", bytes, {.unit = 1e-3});
  for (Vec3 &x : soup.node)
    x *= 1e-3;
  check_is(small, soup);
  const dem::Surface turned = read(folder, "a.stl", bytes, {.unit = 1e-3, .flip = true, .use = SurfaceUse::vessel});
  CHECK(enclosed_moments(turned.view(), Vec3::Zero())[0] == Approx(-8. * 24e-9));
}

TEST_CASE("nodes in the same place become one, to the tolerance, and no others")
{
  const TemporaryFolder folder;
  Soup soup = soup_of(cube());
  soup.node.push_back(soup.node[7] + Vec3(0., 1.5e-6, 0.)); // of a longest side of 2
  soup.node.push_back(Vec3(5., 5., 5.));                    // of no triangle
  const auto replace = [&](const std::size_t t, const std::int32_t by)
  { std::replace(soup.triangle[t].begin(), soup.triangle[t].end(), 7, by); };
  replace(3, 8);
  for (const std::string name : {"a.stl", "a.vtu", "a.msh"})
  {
    if (name == "a.msh" && !reads_gmsh)
      continue;
    INFO(name);
    const std::string bytes = name == "a.stl" ? text_stl(soup) : name == "a.vtu" ? vtu(soup) : gmsh_2(soup);
    const dem::Surface merged = read(folder, name, bytes, {.use = SurfaceUse::body});
    CHECK(merged.topology.n_nodes() == 8);
    CHECK(merged.topology.is_closed());
    CHECK_FALSE(read(folder, name, bytes, {.merge_tolerance = 2e-7}).topology.is_closed());
  }
  // A chain of nodes nearer than the tolerance stays a line.
  Soup strip;
  constexpr int n = 100;
  for (int k = 0; k <= n; ++k)
    strip.node.insert(strip.node.end(), {Vec3(0.008 * k, 0., 0.), Vec3(0.008 * k, 1., 0.)});
  for (int k = 0; k < n; ++k)
    strip.triangle.insert(strip.triangle.end(), {{2 * k, 2 * k + 2, 2 * k + 1}, {2 * k + 1, 2 * k + 2, 2 * k + 3}});
  CHECK(read(folder, "a.vtu", vtu(strip), {.merge_tolerance = 7e-3}).topology.n_nodes() == 2 * (n + 1));
}

TEST_CASE("quadrilaterals are cut along their shorter diagonal, points and lines left out")
{
  const TemporaryFolder folder;
  const std::vector<Vec3> node{Vec3(0., 0., 0.), Vec3(1., 0., 0.), Vec3(1., 1., 0.), Vec3(-1., 2., 0.)};
  const VtuCells cells{{{0}, {0, 1, 2, 3}, {0, 1}}, {1, 9, 3}};
  for (const auto place : {VtuForm::Place::text, VtuForm::Place::appended_raw})
    CHECK(read(folder, "a.vtu", VtuText(node, cells, {place}).text).topology.triangle ==
          std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}});
  std::vector<Vec3> other = node;
  other[2] = Vec3(4., 4., 0.);
  CHECK(read(folder, "a.vtu", VtuText(other, cells, {}).text).topology.triangle ==
        std::vector<Triangle>{{0, 1, 3}, {1, 2, 3}});
  const std::string mesh = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 -1 2 0\n"
                           "$EndNodes\n$Elements\n1\n1 3 2 0 1 1 2 3 4\n$EndElements\n";
  if (reads_gmsh)
    CHECK(read(folder, "a.msh", mesh).topology.n_faces() == 2);
}

TEST_CASE("pieces of a grid are one surface")
{
  const TemporaryFolder folder;
  Soup low = soup_of(cube()), high = low;
  low.triangle.resize(7);
  high.triangle.erase(high.triangle.begin(), high.triangle.begin() + 7);
  std::reverse(high.node.begin(), high.node.end()); // each piece counts its own points
  for (Triangle &t : high.triangle)
    for (std::int32_t &n : t)
      n = 7 - n;
  std::string text = vtu(low), other = vtu(high);
  const std::size_t start = other.find("<Piece"), end = other.find("</UnstructuredGrid>");
  text.insert(text.find("</UnstructuredGrid>"), other.substr(start, end - start));
  check_is(read(folder, "a.vtu", text, {.use = SurfaceUse::body}), soup_of(cube()));
}

TEST_CASE("files that are none are named")
{
  const TemporaryFolder folder;
  const auto refused = [&](const std::string &name) -> std::string
  {
    try
    {
      read_surface(folder / name);
    }
    catch (const ConfigError &error)
    {
      return error.what();
    }
    return "nothing was refused";
  };
  for (const std::string extension : {".stl", ".msh", ".vtu"})
  {
    if (extension == ".msh" && !reads_gmsh)
      continue;
    CHECK_THAT(refused("none" + extension),
               Contains("none" + extension) && Contains("No such file") && Contains("check its name"));
    std::filesystem::create_directory(folder / ("folder" + extension));
    CHECK_THAT(refused("folder" + extension), Contains("it is a folder"));
    CHECK_THAT(refusal("empty" + extension, ""), Contains("the file is empty"));
    CHECK(refusal("rubbish" + extension, "some text that is not a surface at all, of any format") !=
          "nothing was refused");
  }
  CHECK_THAT(refusal("a.obj", "v 0 0 0"), Contains("extension \".obj\" is not known") && Contains(".stl"));
}

TEST_CASE("a file that is cut off anywhere is refused")
{
  const Soup soup = shifted_cube();
  const TemporaryFolder folder;
  for (const auto &[name, bytes] : all_formats(soup))
  {
    // Of the last bytes only the name of a solid, the ends of elements and a line's end may be missing.
    const std::string essential = bytes.substr(0, bytes.find_last_not_of("\n >") + 1);
    const std::size_t shortest_tail = name == "text.stl" ? std::string("endsolid a part").size() - 7 : 0;
    for (std::size_t size = 1; size + shortest_tail < essential.size(); size += 1 + size / 8)
    {
      INFO(name << ", " << size << " of " << bytes.size() << " bytes");
      ::put(folder / name, bytes.substr(0, size));
      CHECK_THROWS_AS(read_surface(folder / name), ConfigError);
    }
  }
  CHECK_THAT(refusal("a.stl", binary_stl(soup).substr(0, 300)),
             Contains("300 bytes") && Contains("12 triangles") && Contains("684") && Contains("truncated"));
  CHECK_THAT(refusal("a.stl", text_stl(soup).substr(0, 600)), Contains("no \"endsolid\"") && Contains("truncated"));
  if (reads_gmsh)
    CHECK_THAT(refusal("a.msh", gmsh_4(soup).substr(0, 300)), Contains("$EndElements") && Contains("truncated"));
  CHECK_THAT(refusal("a.vtu", vtu(soup).substr(0, 700)), Contains("no whole XML") && Contains("in line"));
  const std::string raw = vtu(soup, {VtuForm::Place::appended_raw});
  CHECK_THAT(refusal("a.vtu", raw.substr(0, raw.size() - 40)), Contains("AppendedData has no end"));
}

TEST_CASE("what is no number or not understood is named")
{
  Soup soup = shifted_cube();
  CHECK_THAT(refusal("a.stl", "solid a\nfacet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nendloop\nendfacet\n"
                              "endsolid a\n"),
             Contains("text STL") && Contains("three vertices"));
  soup.node[3].y() = std::numeric_limits<double>::quiet_NaN();
  CHECK_THAT(refusal("a.stl", binary_stl(soup)), Contains("triangle 0 has a place that is not finite"));
  CHECK_THAT(refusal("a.vtu", vtu(soup, {VtuForm::Place::base64})), Contains("node 3 lies at") && Contains("nan"));
}

TEST_CASE("meshes of Gmsh that cannot be read are refused with its reason")
{
  const Soup soup = shifted_cube();
  if (!reads_gmsh)
  {
    CHECK_THAT(refusal("a.msh", gmsh_2(soup)), Contains("built without Gmsh") && Contains("libgmsh-dev"));
    return;
  }
  CHECK_THAT(refusal("a.msh", "Print(\"a script of Gmsh\");"), Contains("instead of $MeshFormat"));
  std::string mesh = gmsh_2(soup);
  mesh.replace(mesh.find("2.2 0 8"), 3, "9.9");
  CHECK_THAT(refusal("a.msh", mesh), Contains("Gmsh cannot read it (") && Contains("version 9.9"));
  const std::string lines =
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n2\n1 0 0 0\n2 1 0 0\n$EndNodes\n$Elements\n1\n"
      "1 1 2 0 1 1 2\n$EndElements\n";
  CHECK_THAT(refusal("a.msh", lines), Contains("no triangles"));
  const std::string curved =
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n6\n1 0 0 0\n2 2 0 0\n3 0 2 0\n4 1 0 0\n5 1 1 0\n"
      "6 0 1 0\n$EndNodes\n$Elements\n1\n1 9 2 0 1 1 2 3 4 5 6\n$EndElements\n";
  CHECK_THAT(refusal("a.msh", curved), Contains("element 1 is of Gmsh's type 9") && Contains("order 1"));
}

TEST_CASE("files of VTK that cannot be read are refused by name")
{
  const Soup soup = shifted_cube();
  const auto changed =
      [&](const std::string &from, const std::string &to, const VtuForm &form = {VtuForm::Place::base64, true})
  {
    std::string text = vtu(soup, form);
    REQUIRE(text.find(from) != std::string::npos);
    return refusal("a.vtu", text.replace(text.find(from), from.size(), to));
  };
  CHECK_THAT(changed("vtkZLibDataCompressor", "vtkLZ4DataCompressor"),
             Contains("vtkLZ4DataCompressor") && Contains("without compression"));
  CHECK_THAT(changed("LittleEndian", "BigEndian"), Contains("byte_order is BigEndian"));
  CHECK_THAT(changed("type=\"UnstructuredGrid\"", "type=\"PolyData\""), Contains("PolyData"));
  CHECK_THAT(changed("VTKFile", "Other"), Contains("no file of VTK"));
  CHECK_THAT(changed("\"offsets\"", "\"others\""), Contains("no array offsets"));
  CHECK_THAT(changed("\"UInt8\"", "\"String\""), Contains("types") && Contains("type String"));
  CHECK_THAT(changed("NumberOfPoints=\"8\"", "NumberOfPoints=\"9\""), Contains("Points has 24 numbers instead of 27"));
  CHECK_THAT(changed("NumberOfPoints=\"8\"", "NumberOfPoints=\"some\""), Contains("\"some\", which is no number"));
  CHECK_THAT(changed("NumberOfCells=\"12\"", "Number=\"12\""), Contains("lacks its attribute NumberOfCells"));
  CHECK_THAT(changed("format=\"ascii\">\n", "format=\"ascii\">\nx", {}), Contains("entry 0") && Contains("Points"));
  CHECK_THAT(changed("format=\"binary\">\n  ", "format=\"binary\">\n  ??", {VtuForm::Place::base64}),
             Contains("Points is no base64"));
  CHECK_THAT(changed("offset=\"0\"", "offset=\"999999\"", {VtuForm::Place::appended_raw}),
             Contains("begins at byte 999999"));
  // Packed data with a wrong byte.
  std::string text = vtu(soup, {VtuForm::Place::appended_raw, true});
  text[text.find('_', text.find("<AppendedData")) + 60] ^= 0x55;
  CHECK_THAT(refusal("a.vtu", text), Contains("zlib cannot unpack"));
  // Cells.
  const VtuCells tetrahedron{{{0, 1, 2, 3}}, {10}};
  CHECK_THAT(refusal("a.vtu", VtuText(soup.node, tetrahedron, {}).text),
             Contains("cell 0 is of VTK's type 10") && Contains("Extract Surface"));
  const VtuCells far{{{0, 1, 2}, {0, 1, 8}}, {5, 5}};
  CHECK_THAT(refusal("a.vtu", VtuText(soup.node, far, {}).text), Contains("cell 1 names point 8"));
}

TEST_CASE("triangles that make no surface are named with their places")
{
  const auto refused = [](const Soup &soup, const SurfaceFileParameters &parameters = {})
  {
    const std::string in_stl = refusal("a.stl", text_stl(soup), parameters);
    CHECK(in_stl.find("triangle") != std::string::npos);
    return in_stl;
  };
  Soup soup = soup_of(cube());

  Soup flat = soup;
  flat.triangle.push_back({0, 1, 1});
  CHECK_THAT(refused(flat), Contains("triangle 12 around (0.333333, -1, -1) m has no area"));
  flat = soup;
  flat.node.insert(flat.node.end(), {Vec3(-1., 1., 5.), Vec3(0., 1., 5.), Vec3(3., 1., 5.)});
  flat.triangle.push_back({8, 9, 10}); // in one line
  CHECK_THAT(refused(flat), Contains("has no area") && Contains("triangle 12 around (0.666667, 1, 5) m"));

  Soup fin = soup;
  fin.node.push_back(Vec3(0., 0., 3.));
  fin.triangle.push_back({4, 5, 8});
  CHECK_THAT(refused(fin), Contains("share the edge") && Contains("triangle 12 around (0, -0.666667, 1.66667) m"));

  Soup flipped = soup;
  std::swap(flipped.triangle[5][1], flipped.triangle[5][2]);
  CHECK_THAT(refused(flipped), Contains("triangles 2 and 5") && Contains("normals point to different sides") &&
                                   Contains("triangle 5 around "));

  Soup tips = soup; // two bodies that touch in a corner
  for (const Vec3 &x : soup.node)
    tips.node.push_back(x + Vec3(2., 2., 2.));
  for (const Triangle &t : soup.triangle)
    tips.triangle.push_back({t[0] + 8, t[1] + 8, t[2] + 8});
  CHECK_THAT(refused(tips), Contains("hang together by edges"));
}

TEST_CASE("holes are counted and found where a closed surface is wanted")
{
  const TemporaryFolder folder;
  Soup soup = soup_of(cube());
  soup.triangle.erase(soup.triangle.begin() + 11);
  soup.triangle.erase(soup.triangle.begin());
  CHECK_NOTHROW(read(folder, "a.stl", text_stl(soup)));
  for (const SurfaceUse use : {SurfaceUse::body, SurfaceUse::vessel})
    CHECK_THAT(refusal("a.stl", text_stl(soup), {.use = use}),
               Contains("2 holes with 6 open edges") && Contains("of triangle 0 around (0, 0, -1) m"));
  soup = soup_of(cube());
  soup.triangle.pop_back();
  CHECK_THAT(refusal("a.stl", text_stl(soup), {.use = SurfaceUse::body}), Contains("1 hole with 3 open edges"));
}

TEST_CASE("normals to the wrong side of a closed surface are refused")
{
  const TemporaryFolder folder;
  const std::string outwards = text_stl(soup_of(cube()));
  CHECK_NOTHROW(read(folder, "a.stl", outwards, {.use = SurfaceUse::body}));
  CHECK_THAT(refusal("a.stl", outwards, {.use = SurfaceUse::vessel}),
             Contains("encloses 8 m3") && Contains("point outwards") && Contains("flip"));
  CHECK_THAT(refusal("a.stl", outwards, {.flip = true, .use = SurfaceUse::body}),
             Contains("encloses -8 m3") && Contains("point inwards") && Contains("flip"));
}

TEST_CASE("parameters of a surface file out of range are refused")
{
  const std::string bytes = text_stl(soup_of(cube()));
  for (const double unit : {0., -1., std::numeric_limits<double>::infinity(), std::nan("")})
    CHECK_THAT(refusal("a.stl", bytes, {.unit = unit}), Contains("unit") && Contains("0.001 for millimetres"));
  for (const double tolerance : {0., -1., 0.5, std::nan("")})
    CHECK_THAT(refusal("a.stl", bytes, {.merge_tolerance = tolerance}), Contains("merge tolerance"));
  Soup point = soup_of(cube());
  for (Vec3 &x : point.node)
    x = Vec3(1., 2., 3.);
  CHECK_THAT(refusal("a.vtu", vtu(point)), Contains("all nodes lie at (1, 2, 3) m"));
}

TEST_CASE("a surface of another unit than the grains is found by its size")
{
  const std::vector<Vec3> plate{Vec3(-0.1, 0., 7.), Vec3(0.1, 0., 7.), Vec3(0., 0.15, 7.)};
  const auto times = [&](const double factor)
  {
    std::vector<Vec3> node = plate;
    for (Vec3 &x : node)
      x *= factor;
    return node;
  };
  CHECK(extent_of(plate) == Approx(0.2));
  const GrainSizes sand{0.5e-3, 2e-3};
  CHECK_NOTHROW(check_size_against_grains(plate, sand));
  CHECK_THROWS_WITH(check_size_against_grains(times(1e3), sand),
                    Contains("200 m long") && Contains("100000 times the largest grain's radius of 0.002 m") &&
                        Contains("unit = 0.001"));
  CHECK_THROWS_WITH(check_size_against_grains(times(1e-3), sand),
                    Contains("0.0002 m long") && Contains("0.4 times the smallest grain's radius"));
  CHECK_NOTHROW(check_size_against_grains(times(1e-3), sand, {.smallest = 0.1}));
  CHECK_NOTHROW(check_size_against_grains(times(99.), sand));
  CHECK_THROWS_AS(check_size_against_grains(times(101.), sand), ConfigError);
  CHECK_THROWS_AS(check_size_against_grains(plate, {2e-3, 0.5e-3}), ConfigError);
}
