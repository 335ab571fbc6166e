// Loads on parts of a surface, pressures in grains, places of all grains.

#include "dem/measure/extent.h"
#include "dem/measure/grain_pressure.h"
#include "dem/measure/part_loads.h"
#include "dem/measure/stress.h"
#include "tests/surfaces.h"
#include "tests/unit/dem_measure_contacts.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <numbers>
#include <random>

using namespace bergamo;
using namespace bergamo::dem;

namespace
{

constexpr double rounding = 1e-13; // of sums of some hundred terms

/// The nodes of a feature.
std::vector<std::int32_t> nodes_of(const SurfaceTopology &topology, const FeatureOfSurface &f)
{
  if (f.feature == Feature::face)
    return {topology.triangle[f.number].begin(), topology.triangle[f.number].end()};
  if (f.feature == Feature::edge)
    return {topology.edge[f.number].from, topology.edge[f.number].to};
  return {f.number};
}

} // namespace

TEST_CASE("a surface's load is dealt out to its parts, and what touches where they meet to the first")
{
  const test::Surface cube = test::cube();
  const std::vector<dem::Surface> surfaces(2, dem::Surface(cube.node, cube.topology.triangle));
  const auto n_features = static_cast<std::int32_t>(surfaces[0].n_features());
  SurfaceParts parts{.surface = 1, .n_parts = 3, .of_face = {}};
  for (const Triangle &t : cube.topology.triangle) // sides, bottom, top: the first is not that of the first face
  {
    const auto all_at = [&](const double z)
    { return std::all_of(t.begin(), t.end(), [&](const std::int32_t n) { return cube.node[n][2] == z; }); };
    parts.of_face.push_back(all_at(-1.) ? 1 : all_at(1.) ? 2 : 0);
  }
  Particles grains;
  grains.add({Vec3::Ones(), 1., 1.}, 1., Vec3(0.3, -2., 1.), Quaternion::Identity());

  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> number(-1., 1.);
  std::vector<TouchingContact> contacts{measured::contact(0, -1, Vec3::UnitX(), 7.)}; // with a wall
  PartLoad all;
  for (std::int32_t feature = 0; feature < 2 * n_features; ++feature)
  {
    const Vec3 branch(number(random), number(random), number(random)), shear(number(random), 0., number(random));
    TouchingContact c = measured::contact(0, -1, branch, 1.5 + number(random), shear);
    c.state.weight = 0.5;
    c.feature = feature;
    contacts.push_back(c);
    const FeatureOfSurface f = feature_of(surfaces, feature);
    std::int32_t first = 3;
    for (std::size_t t = 0; t < cube.topology.n_faces(); ++t)
    {
      const Triangle &face = cube.topology.triangle[t];
      const std::vector<std::int32_t> nodes = nodes_of(cube.topology, f);
      if (std::all_of(nodes.begin(), nodes.end(),
                      [&](const std::int32_t n) { return std::find(face.begin(), face.end(), n) != face.end(); }))
        first = std::min(first, parts.of_face[t]);
    }
    const std::vector<PartLoad> alone = part_loads(grains, surfaces, {&c, 1}, parts);
    const Vec3 force = 0.5 * (c.state.forces.normal * c.state.normal - shear);
    for (std::int32_t part = 0; part < 3; ++part)
    {
      const double share = f.surface == 1 && part == first ? 1. : 0.;
      CHECK((alone[part].force - share * force).norm() < rounding);
      CHECK((alone[part].moment - share * (grains.position[0] + branch).cross(force)).norm() < rounding);
      CHECK(alone[part].normal == Approx(share * 0.5 * c.state.forces.normal).epsilon(rounding));
      CHECK(alone[part].shear == Approx(share * 0.5 * shear.norm()).epsilon(rounding));
    }
    if (f.surface == 1)
      all.force += force;
  }
  const std::vector<PartLoad> loads = part_loads(grains, surfaces, contacts, parts);
  CHECK((loads[0].force + loads[1].force + loads[2].force - all.force).norm() < rounding * 100.);
}

TEST_CASE("a sphere between two walls has their force over its great circle as pressure along one axis")
{
  // sigma_xx = - 2 R f / V, the others 0.
  const Particles grains = measured::unit_spheres(2);
  const std::vector<TouchingContact> walls{measured::contact(0, -1, Vec3::UnitX(), 3.),
                                           measured::contact(0, -1, -Vec3::UnitX(), 3.)};
  const std::vector<double> pressure = grain_pressures(grains, {}, walls);
  CHECK(pressure[0] == Approx(2. * 3. / 3. / (4. / 3. * std::numbers::pi)).epsilon(rounding));
  CHECK(pressure[1] == 0.);
}

TEST_CASE("pressures of the grains times their volumes add up to what the contacts' branches and forces say")
{
  std::vector<TouchingContact> pairs = measured::random_contacts(50, 200, 0.3), walls;
  std::mt19937_64 random(3);
  std::normal_distribution<double> number;
  for (TouchingContact &c : pairs)
    c.state.point = Vec3(number(random), number(random), number(random));
  for (int k = 0; k < 12; ++k)
    walls.push_back(measured::contact(4 * k, -1, Vec3(0.1 * k, -1., 0.2), 2. + k, Vec3(0.2, 0., 1.)));
  Particles grains = measured::unit_spheres(50);
  for (std::size_t i = 0; i < grains.size(); ++i)
    grains.volume[i] = 1. + 0.1 * static_cast<double>(i);
  const std::vector<double> pressure = grain_pressures(grains, pairs, walls);
  double sum = 0.;
  for (std::size_t i = 0; i < grains.size(); ++i)
    sum += grains.volume[i] * pressure[i];
  CHECK(sum == Approx(-(force_moment(pairs) + force_moment(walls)).trace() / 3.).epsilon(rounding * 10.));

  // The same for each grain, whichever body of the pairs it is.
  std::vector<TouchingContact> other = measured::exchanged(pairs);
  const std::vector<double> same = grain_pressures(grains, other, walls);
  for (std::size_t i = 0; i < grains.size(); ++i)
    CHECK(same[i] == Approx(pressure[i]).margin(rounding * 100.));
}

TEST_CASE("the highest point is that of the turned grain's surface, the centre of mass that of the free ones")
{
  Particles grains;
  CHECK(highest_point(grains) < -1e300);
  CHECK(centre_of_mass(grains) == Vec3::Zero());
  const double angle = 0.4;
  grains.add({Vec3(1., 2., 3.), 1., 1.}, 2., Vec3(5., 6., 7.), Quaternion(Eigen::AngleAxisd(angle, Vec3::UnitX())));
  grains.add({Vec3::Ones(), 1., 1.}, 2., Vec3(1., 2., 3.), Quaternion::Identity());
  CHECK(highest_point(grains) == Approx(7. + std::hypot(2. * std::sin(angle), 3. * std::cos(angle))).epsilon(1e-12));
  CHECK((7. * centre_of_mass(grains) - Vec3(31., 38., 45.)).norm() < 1e-12); // of ellipsoids with volumes 6 : 1
  grains.fix(1);
  CHECK((centre_of_mass(grains) - Vec3(5., 6., 7.)).norm() < 1e-12);
}
