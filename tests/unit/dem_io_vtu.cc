#include "dem/core/error.h"
#include "dem/core/pvd.h"
#include "dem/geometry/clump_mass.h"
#include "dem/geometry/rigid_clump.h"
#include "dem/io/vtu.h"

#include "tests/temporary_folder.h"
#include "tests/unit/vtu_reader.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <map>

using namespace bergamo;
using namespace bergamo::dem;
namespace fs = std::filesystem;

namespace
{

Particles three_grains()
{
  Particles particles;
  const Quaternion turn(Eigen::AngleAxisd(0.7, Vec3(1., 2., -1.).normalized()));
  particles.add({Vec3(1e-3, 1e-3, 1e-3), 1., 1.}, 2650., Vec3(0., 0., 0.), Quaternion::Identity());
  particles.add({Vec3(0.6e-3, 0.4e-3, 0.3e-3), 0.2, 0.2}, 2650., Vec3(3e-3, 0., 1e-3), turn);
  particles.add({Vec3(0.7e-3, 0.5e-3, 0.9e-3), 1.5, 1.3}, 2650., Vec3(0., -2e-3, 0.), turn.conjugate());
  particles.velocity[1] = Vec3(1., 2., 3.);
  particles.id = {10, 5000000000, 12};
  return particles;
}

} // namespace

TEST_CASE("grains are written as closed surfaces of their true volume")
{
  const TemporaryFolder folder;
  const Particles particles = three_grains();
  const std::vector<double> pressure{1., 2., 3.};
  const std::vector<GrainField> fields{{"p < \"5\" & more [Pa]", pressure}};
  const fs::path path = folder / "grains.vtu";
  write_grains_vtu(particles, fields, path);
  CHECK_FALSE(fs::exists(path.string() + ".partial"));

  const VtuReader vtu(content_of(path));
  const auto points = vtu.array<float>("Points");
  const auto corners = vtu.array<std::int32_t>("connectivity");
  const auto ends = vtu.array<std::int32_t>("offsets");
  const auto types = vtu.array<std::uint8_t>("types");
  const auto id = vtu.array<std::int64_t>("id");
  const auto velocity = vtu.array<float>("velocity");
  const auto field = vtu.array<float>("p &lt; &quot;5&quot; &amp; more [Pa]");
  REQUIRE(points.size() == 3 * vtu.n_points);
  REQUIRE(ends.size() == vtu.n_cells);
  REQUIRE(types.size() == vtu.n_cells);
  REQUIRE(id.size() == vtu.n_cells);
  REQUIRE(velocity.size() == 3 * vtu.n_cells);
  REQUIRE(field.size() == vtu.n_cells);
  REQUIRE(static_cast<std::size_t>(ends.back()) == corners.size());
  REQUIRE(vtu.n_cells == 3 * 288);

  const auto point = [&](const int i) { return Vec3(points[3 * i], points[3 * i + 1], points[3 * i + 2]); };
  std::vector<double> enclosed(3, 0.);
  std::map<std::pair<int, int>, int> edges;
  for (std::size_t cell = 0, begin = 0; cell < vtu.n_cells; begin = ends[cell++])
  {
    const std::size_t grain = cell / 288, n = ends[cell] - begin;
    REQUIRE(types[cell] == (n == 3 ? 5 : 9));
    CHECK(id[cell] == particles.id[grain]);
    CHECK(velocity[3 * cell + 1] == (grain == 1 ? 2.f : 0.f));
    CHECK(field[cell] == static_cast<float>(pressure[grain]));
    for (std::size_t k = 0; k < n; ++k)
    {
      const int from = corners[begin + k], to = corners[begin + (k + 1) % n];
      ++edges[{from, to}];
      if (k > 0 && k + 1 < n)
      {
        const Vec3 centre = particles.position[grain];
        enclosed[grain] += (point(corners[begin]) - centre).dot((point(from) - centre).cross(point(to) - centre)) / 6.;
      }
    }
  }
  // Closed and oriented: each edge is passed once either way.
  for (const auto &[edge, n] : edges)
    CHECK((n == 1 && edges.count({edge.second, edge.first}) == 1));
  for (std::size_t grain = 0; grain < 3; ++grain)
    CHECK(enclosed[grain] == Approx(volume(particles.parts.shape[grain])).epsilon(0.03));
}

TEST_CASE("every written point lies on its grain")
{
  const TemporaryFolder folder;
  const Particles particles = three_grains();
  write_grains_vtu(particles, {}, folder / "grains.vtu", 4);
  const VtuReader vtu(content_of(folder / "grains.vtu"));
  const auto points = vtu.array<float>("Points");
  const std::size_t n_each = vtu.n_points / 3;
  for (std::size_t i = 0; i < vtu.n_points; ++i)
  {
    const std::size_t grain = i / n_each;
    const Vec3 body = particles.orientation[grain].conjugate() *
                      (Vec3(points[3 * i], points[3 * i + 1], points[3 * i + 2]) - particles.position[grain]);
    // F is of degree 2/eps in the distance: take it back to the distance.
    const double f = inside_outside(particles.parts.shape[grain], body);
    CHECK(std::pow(f, particles.parts.shape[grain].eps2 / 2.) == Approx(1.).epsilon(1e-5));
  }
}

TEST_CASE("the volume drawn stays near the true one over all shapes")
{
  const TemporaryFolder folder;
  Particles particles;
  std::vector<double> exponents{0.1, 0.3, 0.6, 1., 1.3, 1.7};
  for (const double eps1 : exponents)
    for (const double eps2 : exponents)
      particles.add({Vec3(1.1, 0.8, 0.6), eps1, eps2}, 1., Vec3::Zero(), Quaternion::Identity());
  write_grains_vtu(particles, {}, folder / "grains.vtu");
  const VtuReader vtu(content_of(folder / "grains.vtu"));
  const auto points = vtu.array<float>("Points");
  const auto corners = vtu.array<std::int32_t>("connectivity");
  const auto ends = vtu.array<std::int32_t>("offsets");
  const auto point = [&](const int i) { return Vec3(points[3 * i], points[3 * i + 1], points[3 * i + 2]); };
  std::vector<double> enclosed(particles.size(), 0.);
  for (std::size_t cell = 0, begin = 0; cell < vtu.n_cells; begin = ends[cell++])
    for (std::size_t k = begin + 1; k + 1 < static_cast<std::size_t>(ends[cell]); ++k)
      enclosed[cell / 288] += point(corners[begin]).dot(point(corners[k]).cross(point(corners[k + 1]))) / 6.;
  for (std::size_t grain = 0; grain < particles.size(); ++grain)
  {
    INFO("eps " << particles.parts.shape[grain].eps1 << " " << particles.parts.shape[grain].eps2);
    CHECK(enclosed[grain] == Approx(volume(particles.parts.shape[grain])).epsilon(0.03));
  }
}

TEST_CASE("clumps are written part by part, with what belongs to their particle")
{
  const TemporaryFolder folder;
  const Superquadric ball{Vec3::Constant(1e-3), 1., 1.}, stone{Vec3(0.6e-3, 0.4e-3, 0.9e-3), 0.7, 1.2};
  const Clump clump(ClumpShape{{{ball, Vec3(-2e-3, 0., 0.)}, {stone, Vec3(1e-3, 1e-3, 0.)}}});
  const Quaternion turn(Eigen::AngleAxisd(0.7, Vec3(1., 2., -1.).normalized()));
  Particles particles;
  particles.add(stone, 2650., Vec3(5e-3, 0., 0.), turn);
  particles.add(clump, 2650., Vec3(0., 4e-3, 1e-3), turn);
  particles.add(ball, 2650., Vec3(0., 0., 9e-3), Quaternion::Identity());
  particles.id = {7, 30, 5};
  particles.velocity[1] = Vec3(1., 2., 3.);
  const std::vector<double> pressure{1., 2., 3.};
  const std::vector<GrainField> fields{{"pressure", pressure}};
  write_grains_vtu(particles, fields, folder / "grains.vtu", 4);

  const VtuReader vtu(content_of(folder / "grains.vtu"));
  const std::size_t n_points = 7 * 16 + 2, n_faces = 8 * 16; // of a part
  REQUIRE(vtu.n_points == 4 * n_points);
  REQUIRE(vtu.n_cells == 4 * n_faces);
  const auto points = vtu.array<float>("Points");
  const auto corners = vtu.array<std::int32_t>("connectivity");
  const auto id = vtu.array<std::int64_t>("id");
  const auto velocity = vtu.array<float>("velocity"), radius = vtu.array<float>("bounding_radius"),
             field = vtu.array<float>("pressure");
  REQUIRE(points.size() == 3 * vtu.n_points);
  REQUIRE(id.size() == vtu.n_cells);
  REQUIRE(field.size() == vtu.n_cells);
  CHECK(*std::max_element(corners.begin(), corners.end()) == static_cast<std::int32_t>(vtu.n_points) - 1);
  for (std::size_t cell = 0; cell < vtu.n_cells; ++cell)
  {
    const std::size_t particle = std::vector<std::size_t>{0, 1, 1, 2}[cell / n_faces];
    CHECK(id[cell] == particles.id[particle]);
    CHECK(velocity[3 * cell + 1] == (particle == 1 ? 2.f : 0.f));
    CHECK(radius[cell] == static_cast<float>(particles.bounding_radius[particle]));
    CHECK(field[cell] == static_cast<float>(pressure[particle]));
  }
  // Every point lies on its part, in the frame in which the clump was given.
  const MassProperties mass = mass_properties(ClumpShape{{{ball, Vec3(-2e-3, 0., 0.)}, {stone, Vec3(1e-3, 1e-3, 0.)}}});
  for (std::size_t i = 0; i < vtu.n_points; ++i)
  {
    const std::size_t part = i / n_points;
    const Vec3 point(points[3 * i], points[3 * i + 1], points[3 * i + 2]);
    Vec3 body = turn.conjugate() * (point - particles.position[part == 0 ? 0 : 1]);
    if (part == 1 || part == 2)
      body = mass.centre + mass.orientation * body - (part == 1 ? Vec3(-2e-3, 0., 0.) : Vec3(1e-3, 1e-3, 0.));
    if (part == 3)
      body = point - particles.position[2];
    const Superquadric &shape = part == 0 || part == 2 ? stone : ball;
    CHECK(std::pow(inside_outside(shape, body), shape.eps2 / 2.) == Approx(1.).epsilon(1e-5));
  }
}

TEST_CASE("no grains make a file without cells")
{
  const TemporaryFolder folder;
  write_grains_vtu({}, {}, folder / "grains.vtu");
  const VtuReader vtu(content_of(folder / "grains.vtu"));
  CHECK(vtu.n_points == 0);
  CHECK(vtu.n_cells == 0);
  CHECK(vtu.array<float>("Points").empty());
}

TEST_CASE("mistakes in writing grains are named")
{
  const TemporaryFolder folder;
  const Particles particles = three_grains();
  const std::vector<double> two{1., 2.};
  const std::vector<GrainField> fields{{"pressure", two}};
  CHECK_THROWS_WITH(write_grains_vtu(particles, fields, folder / "grains.vtu"),
                    Catch::Contains("'pressure'") && Catch::Contains("2 values for 3 grains"));
  CHECK_THROWS_AS(write_grains_vtu(particles, {}, folder / "grains.vtu", 5), ConfigError);
  CHECK_THROWS_AS(write_grains_vtu(particles, {}, folder / "no/grains.vtu"), RunError);
  CHECK_THROWS_AS(write_pvd(folder / "no/grains.pvd", {}), RunError);
  CHECK(fs::is_empty(folder.path()));
}

TEST_CASE("a collection lists its frames with their times to the last digit")
{
  const TemporaryFolder folder;
  const std::vector<std::pair<double, std::string>> frames{{0., "grains_0.vtu"}, {0.1 + 0.2, "a&b.vtu"}};
  write_pvd(folder / "grains.pvd", frames);
  const std::string text = content_of(folder / "grains.pvd");
  CHECK_THAT(text, Catch::Contains("<VTKFile type=\"Collection\"") &&
                       Catch::Contains("timestep=\"0\" part=\"0\" file=\"grains_0.vtu\"") &&
                       Catch::Contains("timestep=\"0.30000000000000004\"") && Catch::Contains("a&amp;b.vtu") &&
                       Catch::EndsWith("</VTKFile>\n"));
}
