#include "dem/core/error.h"
#include "dem/io/contacts_vtu.h"
#include "dem/io/grain_points_vtu.h"
#include "dem/io/grid_vtu.h"

#include "tests/temporary_folder.h"
#include "tests/unit/vtu_reader.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

using namespace bergamo;
using namespace bergamo::dem;
using Catch::Matchers::Contains;

TEST_CASE("a grid is written as hexahedra that fill its box, with the values of its nodes and cells")
{
  const HexahedronGrid grid{{Vec3(-1., 0., 2.), Vec3(5., 1., 4.)}, {3, 1, 2}};
  std::vector<Vec3> velocity;
  std::vector<double> height;
  for (std::int32_t node = 0; node < 24; ++node)
  {
    velocity.push_back(2. * grid.node(node));
    height.push_back(grid.node(node).z());
  }
  TemporaryFolder folder;
  const GridField fields[] = {{"velocity", std::span<const Vec3>(velocity)},
                              {"height", std::span<const double>(height)}};
  const std::vector<double> number{0., 1., 2., 3., 4., std::numeric_limits<double>::quiet_NaN()};
  const GridField of_cells[] = {{"number", std::span<const double>(number)}};
  write_grid_vtu(grid, {.of_nodes = fields, .of_cells = of_cells}, folder / "grid.vtu");
  const VtuReader file(content_of(folder / "grid.vtu"));
  REQUIRE(file.n_points == 24);
  REQUIRE(file.n_cells == 6);
  const auto points = file.array<double>("Points"), values = file.array<double>("velocity");
  const auto nodes = file.array<std::int32_t>("connectivity");
  const auto place = [&](const std::size_t node)
  { return Vec3(points[3 * node], points[3 * node + 1], points[3 * node + 2]); };
  for (std::size_t k = 0; k < points.size(); ++k)
    CHECK(values[k] == 2. * points[k]);
  CHECK(file.array<double>("height") == height);
  const auto numbers = file.array<double>("number");
  REQUIRE(numbers.size() == 6);
  CHECK(std::equal(numbers.begin(), numbers.end() - 1, number.begin()));
  CHECK(std::isnan(numbers.back())); // not known
  CHECK(file.array<std::uint8_t>("types") == std::vector<std::uint8_t>(6, 12));
  for (std::size_t cell = 0; cell < 6; ++cell) // VTK's order: around the lower face, then around the upper one
  {
    const Vec3 low = place(nodes[8 * cell]), edges = grid.cell_edges();
    const Vec3 corners[] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
    for (int n = 0; n < 8; ++n)
      CHECK((place(nodes[8 * cell + n]) - low - edges.cwiseProduct(corners[n])).norm() < 1e-14);
    CHECK((low - grid.box.low - edges.cwiseProduct(Vec3(cell % 3, 0., cell / 3))).norm() < 1e-14);
  }
  CHECK(file.array<std::int64_t>("offsets").back() == 48);
}

TEST_CASE("a field of another grid is refused")
{
  TemporaryFolder folder;
  const std::vector<double> few(3, 0.);
  const GridField fields[] = {{"few", std::span<const double>(few)}};
  CHECK_THROWS_WITH(write_grid_vtu({}, {.of_nodes = fields}, folder / "grid.vtu"),
                    Contains("field few") && Contains("nodes, 8"));
  CHECK_THROWS_WITH(write_grid_vtu({}, {.of_cells = fields}, folder / "grid.vtu"),
                    Contains("field few") && Contains("cells, 1"));
  CHECK_FALSE(std::filesystem::exists(folder / "grid.vtu"));
}

TEST_CASE("grains are written as points with their diameters and fields")
{
  Particles grains;
  grains.add({Vec3(2., 1., 0.5), 1., 1.}, 1., Vec3(1., 2., 3.), Quaternion::Identity());
  grains.add({Vec3::Constant(0.25), 1., 1.}, 1., Vec3(4., 5., 6.), Quaternion::Identity());
  grains.id = {7, 3};
  grains.velocity[1] = Vec3(0., -0.5, 8.);
  const std::vector<double> heights{10., 20.};
  TemporaryFolder folder;
  const GrainField fields[] = {{"start_height", heights}};
  write_grain_points_vtu(grains, fields, folder / "grains.vtu");
  const VtuReader file(content_of(folder / "grains.vtu"));
  REQUIRE(file.n_points == 2);
  REQUIRE(file.n_cells == 2);
  CHECK(file.array<float>("Points") == std::vector<float>{1, 2, 3, 4, 5, 6});
  CHECK(file.array<float>("velocity") == std::vector<float>{0, 0, 0, 0, -0.5, 8});
  CHECK(file.array<std::int64_t>("id") == std::vector<std::int64_t>{7, 3});
  CHECK(file.array<float>("start_height") == std::vector<float>{10, 20});
  CHECK(file.array<float>("diameter")[0] == Approx(2.)); // of the sphere of equal volume, 2 * 1 * 0.5 = 1^3
  CHECK(file.array<float>("diameter")[1] == Approx(0.5));
  CHECK(file.array<std::int32_t>("connectivity") == std::vector<std::int32_t>{0, 1});
  CHECK(file.array<std::uint8_t>("types") == std::vector<std::uint8_t>{1, 1});
  const GrainField wrong[] = {{"short", std::span(heights).first(1)}};
  CHECK_THROWS_WITH(write_grain_points_vtu(grains, wrong, folder / "grains.vtu"), Contains("'short'"));
}

TEST_CASE("contacts are written as lines between centres, and to walls, with their forces")
{
  Particles grains;
  for (int i = 0; i < 3; ++i)
    grains.add({Vec3::Ones(), 1., 1.}, 1., Vec3(i, 2. * i, 0.), Quaternion::Identity());
  grains.id = {7, 5, 6};
  std::vector<TouchingContact> contacts(2);
  contacts[0].first = 0;
  contacts[0].second = 2;
  contacts[0].branch = Vec3(2., 4., 0.);
  contacts[0].state.weight = 0.5;
  contacts[0].state.forces = {Vec3(0., 0., 6.), 3.};
  contacts[0].state.normal = Vec3(0., 0.5, 0.25);
  contacts[0].state.point = Vec3(0., 0., 0.125);
  contacts[0].state.overlap = 0.25;
  contacts[1].first = 1;
  contacts[1].second = no_grain;
  contacts[1].branch = Vec3(0., 0., -1.);
  TemporaryFolder folder;
  write_contacts_vtu(grains, contacts, folder / "contacts.vtu");
  const VtuReader file(content_of(folder / "contacts.vtu"));
  REQUIRE(file.n_points == 4);
  REQUIRE(file.n_cells == 2);
  CHECK(file.array<double>("Points") == std::vector<double>{0., 0., 0., 2., 4., 0., 1., 2., 0., 1., 2., -1.});
  CHECK(file.array<std::int32_t>("connectivity") == std::vector<std::int32_t>{0, 1, 2, 3});
  CHECK(file.array<std::int64_t>("offsets") == std::vector<std::int64_t>{2, 4});
  CHECK(file.array<std::uint8_t>("types") == std::vector<std::uint8_t>{3, 3});
  CHECK(file.array<std::int64_t>("first") == std::vector<std::int64_t>{7, 5});
  CHECK(file.array<std::int64_t>("second") == std::vector<std::int64_t>{6, -1});
  CHECK(file.array<float>("normal_force") == std::vector<float>{1.5f, 0.f});
  CHECK(file.array<float>("tangential_force") == std::vector<float>{0.f, 0.f, 3.f, 0.f, 0.f, 0.f});
  CHECK(file.array<float>("normal") == std::vector<float>{0.f, 0.5f, 0.25f, 0.f, 0.f, 0.f});
  CHECK(file.array<double>("point") ==
        std::vector<double>{1., 2., 0.125, 1., 2., -1.}); // off the middle; the wall's end
  CHECK(file.array<float>("overlap") == std::vector<float>{0.25f, 0.f});
}
