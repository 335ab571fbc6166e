#include "dem/core/error.h"
#include "fe_dealii/explicit_body.h"
#include "fe_dealii/mesh/box_mesh.h"
#include "fe_dealii/mesh/mesh_check.h"
#include "fe_dealii/mesh/mesh_file.h"
#include "tests/temporary_folder.h"

#include <deal.II/grid/tria.h>

#include <catch2/catch.hpp>

#include <map>
#include <sstream>

using namespace bergamo;
using namespace bergamo::fe;
using Catch::Matchers::Contains;
using Catch::Matchers::Predicate;

namespace
{

using Mesh = dealii::Triangulation<3>;

/// A mesh in the order of Gmsh and UCD: around the bottom, then around the top.
struct Drawing
{
  std::vector<std::array<double, 3>> vertices;
  std::vector<std::array<int, 8>> hexahedra;
  int last_volume = 1; ///< number of the last hexahedron's volume; all others belong to 1
  std::vector<std::pair<int, std::array<int, 4>>> faces; ///< with their numbers

  /// A brick with its edges at 0 and `size` from `corner` on, its vertices joined to those that are there if they are
  /// `joined`.
  void add_brick(const std::array<double, 3> &corner, const std::array<double, 3> &size, const bool joined = true)
  {
    constexpr int turn[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
    const std::size_t n_before = vertices.size();
    std::array<int, 8> brick;
    for (int k = 0; k < 8; ++k)
    {
      std::array<double, 3> x;
      for (int i = 0; i < 3; ++i)
        x[i] = corner[i] + turn[k][i] * size[i];
      const auto end = vertices.begin() + n_before;
      const auto there = joined ? std::find(vertices.begin(), end, x) : end;
      brick[k] = there - vertices.begin();
      if (there == end)
      {
        brick[k] = vertices.size();
        vertices.push_back(x);
      }
    }
    hexahedra.push_back(brick);
  }

  int volume_of(const std::array<int, 8> &hexahedron) const { return hexahedron == hexahedra.back() ? last_volume : 1; }

  std::string as_gmsh2() const
  {
    std::ostringstream text;
    text << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n" << vertices.size() << '\n';
    for (std::size_t v = 0; v < vertices.size(); ++v)
      text << v + 1 << ' ' << vertices[v][0] << ' ' << vertices[v][1] << ' ' << vertices[v][2] << '\n';
    text << "$EndNodes\n$Elements\n" << faces.size() + hexahedra.size() << '\n';
    int element = 0;
    for (const auto &[number, face] : faces)
    {
      text << ++element << " 3 2 " << number << ' ' << number;
      for (const int v : face)
        text << ' ' << v + 1;
      text << '\n';
    }
    for (const auto &hexahedron : hexahedra)
    {
      const int volume = volume_of(hexahedron);
      text << ++element << " 5 2 " << volume << ' ' << volume;
      for (const int v : hexahedron)
        text << ' ' << v + 1;
      text << '\n';
    }
    text << "$EndElements\n";
    return text.str();
  }

  std::string as_ucd() const
  {
    std::ostringstream text;
    text << "# drawn by hand\n" << vertices.size() << ' ' << faces.size() + hexahedra.size() << " 0 0 0\n";
    for (std::size_t v = 0; v < vertices.size(); ++v)
      text << v + 1 << ' ' << vertices[v][0] << ' ' << vertices[v][1] << ' ' << vertices[v][2] << '\n';
    int element = 0;
    for (const auto &hexahedron : hexahedra)
    {
      text << ++element << ' ' << volume_of(hexahedron) << " hex";
      for (const int v : hexahedron)
        text << ' ' << v + 1;
      text << '\n';
    }
    for (const auto &[number, face] : faces)
    {
      text << ++element << ' ' << number << " quad";
      for (const int v : face)
        text << ' ' << v + 1;
      text << '\n';
    }
    return text.str();
  }
};

/// Two bricks along x from 0 to 3, the faces x− = 7 and x+ = 9.
Drawing two_bricks(const bool joined = true)
{
  Drawing drawing;
  drawing.add_brick({0, 0, 0}, {1, 2, 4}, joined);
  drawing.add_brick({1, 0, 0}, {2, 2, 4}, joined);
  const auto &a = drawing.hexahedra[0], &b = drawing.hexahedra[1];
  drawing.faces = {{7, {a[0], a[3], a[7], a[4]}}, {9, {b[1], b[2], b[6], b[5]}}};
  return drawing;
}

/// Gmsh's present default, one brick between 0 and (1, 2, 4) with the face x− = 7.
const char *const gmsh41 = R"($MeshFormat
4.1 0 8
$EndMeshFormat
$Entities
0 0 1 1
5 0 0 0 0 2 4 1 7 0
1 0 0 0 1 2 4 1 3 0
$EndEntities
$Nodes
1 8 1 8
3 1 0 8
1
2
3
4
5
6
7
8
0 0 0
1 0 0
1 2 0
0 2 0
0 0 4
1 0 4
1 2 4
0 2 4
$EndNodes
$Elements
2 2 1 2
2 5 3 1
1 1 4 8 5
3 1 5 1
2 1 2 3 4 5 6 7 8
$EndElements
)";

std::map<unsigned int, int> faces_of(const Mesh &mesh)
{
  std::map<unsigned int, int> result;
  for (const auto &face : mesh.active_face_iterators())
    if (face->at_boundary())
      ++result[face->boundary_id()];
  return result;
}

double volume_of(const Mesh &mesh)
{
  double volume = 0;
  for (const auto &cell : mesh.active_cell_iterators())
    volume += cell->measure();
  return volume;
}

/// What is thrown for a file of this name and content.
std::string complaint(const std::string &name, const std::string &content, const double unit = 1)
{
  TemporaryFolder folder;
  put(folder / name, content);
  Mesh mesh;
  try
  {
    read_mesh(folder / name, mesh, unit);
  }
  catch (const ConfigError &error)
  {
    CHECK(mesh.n_levels() == 0); // so that another file may be read into it
    CHECK_THAT(error.what(), Contains((folder / name).string()));
    CHECK_THAT(error.what(), Predicate<std::string>([](const std::string &text)
                                                    { return text.find('\n') == text.npos && text.size() < 600; },
                                                    "is one line"));
    return error.what();
  }
  return "";
}

Mesh read(const Drawing &drawing)
{
  TemporaryFolder folder;
  put(folder / "drawing.msh", drawing.as_gmsh2());
  Mesh mesh;
  read_mesh(folder / "drawing.msh", mesh);
  return mesh;
}

} // namespace

TEST_CASE("Mesh files of Gmsh and UCD: the cells, the numbers of the boundaries, the unit", "[fe]")
{
  TemporaryFolder folder;
  put(folder / "bar.msh", two_bricks().as_gmsh2());
  put(folder / "bar.inp", two_bricks().as_ucd());
  put(folder / "BAR.UCD", two_bricks().as_ucd());
  for (const char *const name : {"bar.msh", "bar.inp", "BAR.UCD"})
  {
    CAPTURE(name);
    Mesh mesh;
    read_mesh(folder / name, mesh, 0.01);
    CHECK(mesh.n_active_cells() == 2);
    CHECK(volume_of(mesh) == Approx(24e-6));
    CHECK(faces_of(mesh) == std::map<unsigned int, int>{{0, 8}, {7, 1}, {9, 1}});
    const ExplicitBody body(mesh, {});
    for (const unsigned int node : body.boundary_nodes(7))
      CHECK(body.node_position()[node][0] == 0);
    for (const unsigned int node : body.boundary_nodes(9))
      CHECK(body.node_position()[node][0] == Approx(0.03));
  }
  put(folder / "new.msh", gmsh41);
  Mesh mesh;
  read_mesh(folder / "new.msh", mesh);
  CHECK(volume_of(mesh) == Approx(8));
  CHECK(faces_of(mesh) == std::map<unsigned int, int>{{0, 5}, {7, 1}});
  CHECK_THROWS_WITH(read_mesh(folder / "new.msh", mesh), Contains("already holds 1 cells"));
}

TEST_CASE("Mesh files: the volumes' numbers choose the materials", "[fe]")
{
  TemporaryFolder folder;
  Drawing drawing = two_bricks();
  drawing.last_volume = 12;
  put(folder / "bar.msh", drawing.as_gmsh2());
  put(folder / "bar.inp", drawing.as_ucd());
  for (const char *const name : {"bar.msh", "bar.inp"})
  {
    CAPTURE(name);
    Mesh mesh;
    read_mesh(folder / name, mesh);
    ExplicitBodyParameters parameters;
    parameters.layers = {{1, LinearElastic({.density = 1500})}, {12, LinearElastic({.density = 2500})}};
    const ExplicitBody body(mesh, parameters);
    REQUIRE(body.n_elements() == 2);
    for (std::size_t e = 0; e < 2; ++e)
    {
      const bool is_second = body.reference_centre(e)[0] > 1;
      CHECK(body.material_id(e) == (is_second ? 12 : 1));
      CHECK(density(body.material(e)) == (is_second ? 2500 : 1500));
    }
    double mass = 0;
    for (std::size_t node = 0; node < body.n_nodes(); ++node)
      mass += body.mass()[3 * node];
    CHECK(mass == Approx(8 * 1500 + 16 * 2500));
    parameters.layers.erase(12);
    CHECK_THROWS_WITH(ExplicitBody(mesh, parameters), Contains("material id 12, which has no material"));
  }
}

TEST_CASE("Mesh files: what cannot be read is named, with the file and the remedy", "[fe]")
{
  const std::string gmsh = two_bricks().as_gmsh2(), ucd = two_bricks().as_ucd();
  CHECK_THAT(complaint("bar.stl", gmsh), Contains("extension \".stl\"") && Contains(".msh") && Contains(".inp"));
  CHECK_THAT(complaint("bar", gmsh), Contains("extension \"\""));
  CHECK_THAT(complaint("bar.msh", gmsh, 0), Contains("unit = 0 m") && Contains("0.001"));
  CHECK_THAT(complaint("bar.msh", ""), Contains("empty"));
  CHECK_THAT(complaint("bar.msh", ucd), Contains("begins with \"#\"") && Contains("Gmsh"));
  CHECK_THAT(complaint("bar.inp", "*HEADING\n"), Contains("\"*HEADING\"") && Contains("Abaqus"));
  CHECK_THAT(complaint("bar.msh", "$MeshFormat\n4.1 1 8\n"), Contains("binary") && Contains("text"));
  CHECK_THAT(complaint("bar.msh", "$MeshFormat\n9 0 8\n"), Contains("version 9") && Contains("4.1"));
  // Cut off where the cells are listed, and in UCD a number of cells that are not there.
  CHECK_THAT(complaint("bar.msh", gmsh.substr(0, gmsh.find("$EndElements") - 20)), Contains("cannot be read ("));
  CHECK_THAT(complaint("bar.inp", ucd.substr(0, ucd.find("quad"))), Contains("cannot be read ("));
  Drawing surface_alone = two_bricks();
  surface_alone.hexahedra.clear();
  CHECK_THAT(complaint("bar.msh", surface_alone.as_gmsh2()), Contains("cannot be read (") && Contains("hexahedra"));

  Drawing inner_face = two_bricks(); // between the bricks
  const auto &brick = inner_face.hexahedra[0];
  inner_face.faces.push_back({5, {brick[1], brick[2], brick[6], brick[5]}});
  CHECK_THAT(complaint("bar.msh", inner_face.as_gmsh2()), Contains("cannot be read (") && Contains("on its surface"));

  TemporaryFolder folder;
  Mesh mesh;
  CHECK_THROWS_WITH(read_mesh(folder / "absent.msh", mesh), Contains("absent.msh: no such file"));
  std::filesystem::create_directory(folder / "folder.msh");
  CHECK_THROWS_WITH(read_mesh(folder / "folder.msh", mesh), Contains("no such file"));
}

TEST_CASE("Meshes are checked: sound ones pass", "[fe]")
{
  Mesh graded; // flat bricks, and far from the origin
  make_box({{1000, 0, 0}, {1001, 1, 1}, {3, 4, 5}, {1, 1, 400}}, graded);
  CHECK_NOTHROW(check_mesh(graded));
  graded.refine_global(1);
  CHECK_NOTHROW(check_mesh(graded));
  CHECK_NOTHROW(read(two_bricks()));
}

TEST_CASE("Meshes are checked: cells inside out or flat, seams, pieces, no hexahedra", "[fe]")
{
  Mesh mesh;
  CHECK_THROWS_WITH(check_mesh(mesh), Contains("no cells") && Contains("hexahedra"));

  make_box({{0, 0, 0}, {2, 1, 1}, {2, 1, 1}}, mesh);
  auto second = ++mesh.begin_active();
  REQUIRE(second->vertex(7) == dealii::Point<3>(2, 1, 1));
  second->vertex(7) = dealii::Point<3>(0.9, 0.9, 0.9);
  CHECK_THROWS_WITH(check_mesh(mesh), Contains("cell 1 with its centre at (1.3625, 0.4875, 0.4875) m") &&
                                          Contains("inside out") && Contains("move that vertex"));
  // A corner that lies in the plane of its neighbours: no volume there, but no negative one either.
  second->vertex(7) = dealii::Point<3>(5 / 3., 2 / 3., 2 / 3.);
  CHECK_THROWS_WITH(check_mesh(mesh), Contains("cell 1") && Contains("is flat at its corner (1.66667, 0.666667"));
  second->vertex(7) = second->vertex(6); // an edge without length
  CHECK_THROWS_WITH(check_mesh(mesh), Contains("is flat"));
  CHECK_THROWS_AS(check_mesh(mesh), ConfigError);

  CHECK_THROWS_WITH(read(two_bricks(false)),
                    Contains("vertices coincide at (1, ") && Contains("4 pairs") && Contains("Coherence"));
  // A crack between two rows of bricks: all bricks hang together, and one pair of vertices does not.
  Drawing crack;
  for (int x = 0; x < 3; ++x)
    for (int y = 0; y < 2; ++y)
      crack.add_brick({double(x), double(y), 0}, {1, 1, 1});
  for (int v = 0; v < 8; ++v)
    if (const auto x = crack.vertices[crack.hexahedra[5][v]]; x[0] == 3 && x[1] == 1)
    {
      crack.hexahedra[5][v] = crack.vertices.size();
      crack.vertices.push_back({x[0], x[1] + 1e-6, x[2]});
    }
  CHECK_THROWS_WITH(read(crack), Contains("vertices coincide at (3, 1") && Contains("2 pairs"));

  Drawing apart = two_bricks();
  apart.add_brick({5, 0, 0}, {1, 1, 1});
  CHECK_THROWS_WITH(read(apart), Contains("2 pieces") && Contains("of 1 of its 3 cells") &&
                                     Contains("at (5.5, 0.5, 0.5) m") && Contains("join"));
  Drawing hinge; // an edge alone
  hinge.add_brick({0, 0, 0}, {1, 1, 1});
  hinge.add_brick({1, 1, 0}, {1, 1, 1});
  CHECK_THROWS_WITH(read(hinge), Contains("2 pieces"));

  TemporaryFolder folder;
  put(folder / "tetrahedron.msh",
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n"
      "$EndNodes\n$Elements\n1\n1 4 2 1 1 1 2 3 4\n$EndElements\n");
  Mesh tetrahedron;
  CHECK_THROWS_WITH(read_mesh(folder / "tetrahedron.msh", tetrahedron),
                    Contains("tetrahedron.msh: ") && Contains("is a Tet") && Contains("only hexahedra"));
  CHECK(tetrahedron.n_levels() == 0); // as it was
}
