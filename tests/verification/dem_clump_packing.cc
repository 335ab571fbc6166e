#include "dem/core/error.h"
#include "dem/io/snapshot.h"
#include "dem/loading/compression.h"
#include "dem/motion/cell_control.h"
#include "dem/packing/overlap.h"
#include "dem/packing/pack_grains.h"
#include "dem/simulation/simulation.h"

#include "tests/temporary_folder.h"
#include "tests/threads.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <memory>
#include <random>
#include <tuple>
#include <utility>
#include <vector>

using namespace bergamo;
using namespace bergamo::dem;

namespace
{

/// A bent body of a box, an ellipsoid and a sphere, of unit size.
Clump bent()
{
  return Clump(ClumpShape{{{{Vec3(0.7, 0.5, 0.5), 0.6, 0.7}, Vec3::Zero()},
                           {{Vec3(0.4, 0.4, 0.6), 1., 1.}, Vec3(0.8, 0., 0.5)},
                           {{Vec3::Constant(0.45), 1., 1.}, Vec3(-0.8, 0.1, 0.)}}},
               1e-4);
}

ClumpGrading sand()
{
  UniformSizes sizes;
  sizes.smallest_diameter = 0.8e-3;
  sizes.largest_diameter = 1.2e-3;
  return {bent(), sizes};
}

SimulationParameters soft()
{
  SimulationParameters p;
  p.grain() = p.wall() = {1e8, 0.2, 2650.};
  p.between_grains().friction = 0.3;
  p.with_walls().friction = 0.1;
  p.set_damping(0.5);
  p.time_step = 2e-6;
  return p;
}

std::vector<Clump> clumps(const double solid_volume, const std::uint64_t seed = 3)
{
  std::mt19937_64 generator(seed);
  return draw_clumps(sand(), solid_volume, generator);
}

/// Every overlap of two parts of different bodies, in all images, each pair of bodies tried once; without any grid.
int overlaps(const Particles &p)
{
  int n = 0;
  const Parts &parts = p.parts;
  const auto placed = [&](const std::size_t k)
  {
    return PlacedGrain{parts.shape[k], make_pose(parts.shape[k], p.part_position(k), p.part_orientation(k)),
                       parts.bounding_radius[k], inscribed_radius(parts.shape[k])};
  };
  for (std::size_t k = 0; k < parts.size(); ++k)
    for (std::size_t l = 0; l < k; ++l)
    {
      if (parts.particle[k] == parts.particle[l])
        continue;
      const PlacedGrain one = placed(k), other = placed(l);
      for (int image = 0; image < (p.cell.is_periodic() ? n_images : 1); ++image)
      {
        const Vec3 line = other.pose.position - one.pose.position +
                          p.cell.place[p.cell.is_periodic() ? static_cast<std::size_t>(image) : own_image];
        n += line.norm() < one.bounding_radius + other.bounding_radius && !are_apart(one, other, line);
      }
    }
  return n;
}

/// Clumps and plain grains between six walls, under a slanting gravity.
Simulation pouring()
{
  SimulationParameters p = soft();
  p.gravity = Vec3(300., 150., -900.);
  const Box box{Vec3::Zero(), Vec3::Constant(6e-3)};
  auto bodies = clumps(0.2 * box.volume());
  for (std::size_t i = 0; i < bodies.size(); i += 3) // some of one part
    bodies[i] = Clump(i % 2 == 0 ? Superquadric{Vec3::Constant(0.5e-3), 1., 1.}
                                 : Superquadric{Vec3(0.6e-3, 0.4e-3, 0.5e-3), 0.8, 0.9});
  return Simulation(p, add_at_random(bodies, box, 2650., 5), box_walls(box));
}

void run(Simulation &s, const int n_steps)
{
  for (int n = 0; n < n_steps; ++n)
    s.step();
}

/// Clumps in a periodic cell, drawn together until they overlap.
Particles overlapping_cell()
{
  const Box box{Vec3::Zero(), Vec3::Constant(7e-3)};
  Particles p = add_at_random(clumps(0.24 * box.volume()), PackingSpace::periodic(box), 2650., 11);
  constexpr double shrinking = 0.78;
  for (Vec3 &x : p.position)
    x *= shrinking;
  p.cell = PeriodicCell(shrinking * box.edges());
  return p;
}

} // namespace

TEST_CASE("clumps added at random overlap nowhere, lie inside the walls, and are the same on any number of threads")
{
  const Box box{Vec3::Zero(), Vec3(6e-3, 7e-3, 6.5e-3)};
  const auto bodies = clumps(0.2 * box.volume());
  for (const bool is_periodic : {false, true})
  {
    const PackingSpace space = is_periodic ? PackingSpace::periodic(box) : PackingSpace(box);
    std::vector<Particles> made;
    for (const int n : {1, 2, 3})
    {
      const Threads threads(n);
      made.push_back(add_at_random(bodies, space, 2650., 5));
      CHECK(made.back().position == made[0].position);
    }
    Particles &p = made[0];
    REQUIRE(p.size() == bodies.size());
    CHECK(p.parts.size() == 3 * p.size());
    if (is_periodic)
      p.cell = PeriodicCell(box.edges());
    CHECK(overlaps(p) == 0);
    // Nearer than their bounding spheres allow: the parts decide, not the spheres.
    int n_near = 0, n_across = 0;
    for (std::size_t i = 0; i < p.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        n_near +=
            space.nearest_image(p.position[i] - p.position[j]).norm() < p.bounding_radius[i] + p.bounding_radius[j];
    for (std::size_t k = 0; k < p.parts.size(); ++k)
    {
      const auto pose = make_pose(p.parts.shape[k], p.part_position(k), p.part_orientation(k));
      for (int d = 0; d < 3; ++d)
        for (const double sign : {-1., 1.})
        {
          const Vec3 normal = sign * Vec3::Unit(d);
          const double reach = normal.dot(pose.position) + support(pose, normal).height;
          n_across += reach > (sign > 0. ? box.high[d] : -box.low[d]);
        }
    }
    CHECK(n_near > 10);
    CHECK((n_across > 0) == is_periodic);
  }
}

TEST_CASE("clumps are drawn in the sizes of a grading")
{
  const double solid = 2e-7;
  std::mt19937_64 generator(1);
  double sum = 0.;
  for (const Clump &clump : draw_clumps(sand(), solid, generator))
  {
    const double diameter = 2. * equivalent_radius(clump.volume());
    CHECK(diameter >= 0.8e-3 * (1. - 1e-12));
    CHECK(diameter <= 1.2e-3 * (1. + 1e-12));
    sum += clump.volume();
  }
  CHECK(std::abs(sum - solid) < 0.5 * 4.2 * std::pow(0.6e-3, 3));
  // A sieve curve counts the opening that they pass, which of a plain grain is that of the grain.
  const SieveCurve curve = SieveCurve::through(0.64e-3, 0.78e-3, 0.81e-3);
  for (const Clump &clump : draw_clumps({bent(), curve}, solid, generator))
  {
    CHECK(sieve_size(clump) >= curve.points.front().size * (1. - 1e-12));
    CHECK(sieve_size(clump) <= curve.points.back().size * (1. + 1e-12));
  }
  const Superquadric grain{Vec3(0.6, 0.4, 0.5), 0.8, 0.9};
  CHECK(sieve_size(Clump(grain)) == Approx(sieve_size(grain)).epsilon(1e-12));
  CHECK_THROWS_AS(draw_clumps({bent(), UniformSizes{-1., 1., {}}}, solid, generator), ConfigError);
}

TEST_CASE("clumps are packed by random addition, and refused where they would have to be tightened")
{
  const auto space = PackingSpace::periodic({Vec3::Zero(), Vec3::Constant(7e-3)});
  PackingParameters parameters;
  parameters.solid_fraction = 0.2;
  const PackedGrains packed = pack_clumps(sand(), space, parameters, 4);
  CHECK(packed.report.solid_fraction == Approx(0.2).epsilon(1e-12));
  CHECK(packed.report.has_reached_target);
  CHECK(packed.particles.has_clumps());
  parameters.solid_fraction = 0.5;
  CHECK_THROWS_WITH(pack_clumps(sand(), space, parameters, 4),
                    Catch::Contains("0.5") && Catch::Contains("not tightened") && Catch::Contains("0.35"));
}

TEST_CASE("poured clumps have the same bits on 1, 2 and 3 threads and across a restart, and their accounts close")
{
  constexpr int half = 1500;
  std::vector<std::uint64_t> hashes;
  for (const int n : {1, 2, 3})
  {
    const Threads threads(n);
    Simulation s = pouring();
    s.compute_forces();
    const double before = s.energy().balance();
    run(s, half);
    if (n == 1)
    {
      const TemporaryFolder folder;
      ArchiveWriter writer(folder / "snapshot.h5", "clumps");
      write_simulation(writer, s);
      writer.commit();
      const auto restarted = read_simulation(ArchiveReader(folder / "snapshot.h5", "clumps"), soft());
      CHECK(state_hash(*restarted) == state_hash(s));
      run(*restarted, half);
      hashes.push_back(state_hash(*restarted));
    }
    run(s, half);
    hashes.push_back(state_hash(s));
    if (n > 1)
      continue;
    CHECK(s.particles.has_clumps());
    CHECK(s.contacts.n_touching() > 40);
    CHECK(s.contacts.n_touching_walls() > 20);
    CHECK(s.contacts.n_undecided() == 0);
    CHECK(s.n_rebuilds() > 20);
    // Bodies may touch by several parts at once.
    std::map<std::pair<std::int32_t, std::int32_t>, int> contacts_of_pair;
    int most = 0;
    for (const TouchingContact &c : s.contacts.touching(s.particles))
      most = std::max(most, ++contacts_of_pair[{c.first, c.second}]);
    CHECK(most > 1);
    // The friction's trapezoidal rule and contacts that begin within a step: a few per mille of what was converted.
    s.compute_forces();
    const GrainEnergy e = s.energy();
    CHECK(e.friction_loss > 0.);
    CHECK(std::abs(e.balance() - before) < 5e-3 * e.gravity_work);
  }
  for (const std::uint64_t hash : hashes)
    CHECK(hash == hashes.front());
}

TEST_CASE("sorting clumps keeps the history of every contact")
{
  const Threads one_thread(1);
  Simulation s = pouring();
  SimulationParameters p = s.parameters();
  p.sort_interval = 1000000;
  p.contact.overlap_tolerance = 0.01; // so that contacts carry some motion since their last search
  s.change(p);
  run(s, 2000);
  // Contacts by the ids of their bodies; of several between two bodies, by their overlap.
  using Entry = std::tuple<std::int64_t, std::int64_t, double, double, double>;
  const auto history = [](const Simulation &of)
  {
    std::vector<Entry> entries;
    for (const TouchingContact &c : of.contacts.touching(of.particles))
    {
      const auto a = of.particles.id[c.first], b = of.particles.id[c.second];
      entries.emplace_back(std::min(a, b), std::max(a, b), c.state.overlap, c.state.forces.tangential.norm(),
                           c.state.forces.normal);
    }
    for (const TouchingContact &c : of.contacts.touching_walls(of.particles))
      entries.emplace_back(of.particles.id[c.first], -1 - c.wall, c.state.overlap, c.state.forces.tangential.norm(),
                           c.state.forces.normal);
    std::sort(entries.begin(), entries.end());
    return entries;
  };
  Simulation sorted = s;
  sorted.sort_by_place();
  REQUIRE(sorted.particles.id != s.particles.id);
  CHECK(history(sorted) == history(s));
  CHECK(history(s).size() > 60);
  sorted.compute_forces();
  s.compute_forces();
  double largest = 0.;
  for (const Vec3 &f : s.particles.force)
    largest = std::max(largest, f.norm());
  for (std::size_t i = 0; i < s.particles.size(); ++i)
    CHECK((s.particles.force[i] - sorted.particles.force[sorted.index_of(s.particles.id[i])]).norm() < 1e-9 * largest);
}

TEST_CASE("no contact of clumps is missed in a periodic cell, and its mean stress is that over its faces")
{
  const Threads one_thread(1);
  Simulation s(soft(), overlapping_cell(), {});
  for (int n = 0; n < 2; ++n)
  {
    s.compute_forces();
    CHECK(s.contacts.n_touching() == overlaps(s.particles));
    CHECK(s.contacts.n_touching() > 50);
    Mat3 branches = Mat3::Zero(), faces = Mat3::Zero();
    Vec3 places = Vec3::Zero(), sum = Vec3::Zero();
    int n_across = 0;
    for (const TouchingContact &c : s.contacts.touching(s.particles))
    {
      const Vec3 force = c.state.weight * c.state.force();
      branches += c.branch * force.transpose();
      faces += s.particles.cell.place[c.image] * force.transpose();
      n_across += c.image != own_image;
    }
    for (std::size_t i = 0; i < s.particles.size(); ++i)
    {
      places += s.particles.position[i].cwiseProduct(s.particles.force[i]);
      sum += s.particles.force[i];
    }
    const double scale = branches.norm();
    CHECK(n_across > 10);
    CHECK((branches.diagonal() - s.contacts.virial().branch).norm() < 1e-13 * scale);
    CHECK((faces.diagonal() - s.contacts.virial().image).norm() < 1e-13 * scale);
    CHECK((branches.diagonal() - faces.diagonal() + places).norm() < 1e-12 * scale);
    CHECK(sum.norm() < 1e-12 * scale / s.particles.cell.edges[0]);
    run(s, 200);
  }
}

TEST_CASE("a cell of clumps cut elsewhere has the same forces")
{
  const Threads one_thread(1);
  const Particles clumps = overlapping_cell();
  Particles shifted = clumps;
  for (Vec3 &x : shifted.position)
    x += Vec3(1.7e-3, -0.9e-3, 2.3e-3);
  SimulationParameters p = soft();
  p.contact.overlap_tolerance = 0.; // when a contact is searched may depend on which of its bodies is the first
  Simulation one(p, clumps, {}), other(p, shifted, {});
  run(one, 20);
  run(other, 20);
  one.compute_forces();
  other.compute_forces();
  CHECK(one.contacts.n_touching() == other.contacts.n_touching());
  CHECK(one.contacts.n_touching() > 50);
  double largest = 0.;
  for (const Vec3 &f : one.particles.force)
    largest = std::max(largest, f.norm());
  for (std::int64_t id = 0; id < static_cast<std::int64_t>(clumps.size()); ++id)
  {
    const auto i = one.index_of(id), j = other.index_of(id);
    CHECK((one.particles.force[i] - other.particles.force[j]).norm() < 1e-8 * largest);
    CHECK((one.particles.torque[i] - other.particles.torque[j]).norm() <
          1e-8 * largest * one.particles.bounding_radius[i]);
  }
  CHECK((one.cell_stress() - other.cell_stress()).norm() < 1e-8 * one.cell_stress().norm());
}

TEST_CASE("long clumps need a wider periodic cell than their parts")
{
  // Parts of radius r at arms of 3 r: parts reach out of the cell by so much.
  constexpr double r = 1e-3;
  const Superquadric ball{Vec3::Constant(r), 1., 1.};
  Particles p;
  p.add(Clump(ClumpShape{{{ball, Vec3(-3. * r, 0., 0.)}, {ball, Vec3(3. * r, 0., 0.)}}}), 2650., Vec3::Constant(r),
        Quaternion::Identity());
  SimulationParameters parameters = soft();
  parameters.verlet_distance = 0.1; // 2 (2 r + 0.1 r + 3 r) = 10.2 r
  p.cell = PeriodicCell(Vec3::Constant(10.19 * r));
  CHECK_THROWS_WITH(Simulation(parameters, p, {}), Catch::Contains("0.0102"));
  p.cell = PeriodicCell(Vec3::Constant(10.21 * r));
  CHECK_NOTHROW(Simulation(parameters, p, {}));
}

TEST_CASE("clumps are compressed to a pressure, between walls and in a periodic cell")
{
  const Threads one_thread(1);
  const Box box{Vec3::Zero(), Vec3::Constant(5.5e-3)};
  SimulationParameters p = soft();
  Simulation s(p, add_at_random(clumps(0.22 * box.volume()), box, 2650., 5), box_walls(box));
  CompressionParameters fast;
  fast.largest_rate = 100.;
  fast.pressure_tolerance = 0.05;
  fast.force_tolerance = 0.05;
  fast.pressure = 2e4;
  fast.longest_time = 1.;
  Compression compression(fast);
  while (!compression.is_finished())
    compression.step(s); // throws if it does not end
  s.compute_forces();
  CHECK((wall_pressure(s.walls).array() - 2e4).abs().maxCoeff() < 0.06 * 2e4);
  CHECK(s.contacts.n_undecided() == 0);

  Particles cell = add_at_random(clumps(0.22 * box.volume()), PackingSpace::periodic(box), 2650., 5);
  cell.cell = PeriodicCell(box.edges());
  p.time_step = 1e-6;
  Simulation periodic(p, cell, {});
  CellControlParameters control_parameters;
  control_parameters.largest_rate = 100.;
  CellControl control(control_parameters);
  const auto pressed = AxisControl::of_stress(-2e4);
  double sum = 0.;
  constexpr int n_steps = 12000, n_mean = 2000;
  for (int n = 0; n < n_steps; ++n)
  {
    periodic.compute_forces();
    if (n >= n_steps - n_mean)
      sum -= periodic.cell_stress().mean() / n_mean;
    control.act(periodic.particles.cell, {pressed, pressed, pressed}, periodic.cell_stress(), p.time_step);
    periodic.integrate();
  }
  CHECK(sum == Approx(2e4).epsilon(0.1));
  CHECK(periodic.particles.cell.volume() < 0.6 * box.volume());
  CHECK(periodic.contacts.n_undecided() == 0);
}

TEST_CASE("clumps leave and come, and the others keep their contacts")
{
  const Threads one_thread(1);
  Simulation s = pouring();
  run(s, 2000);
  s.compute_forces();
  const double before = s.energy().balance();
  // Every fifth body goes.
  std::vector<std::int32_t> leaving;
  for (std::size_t i = 0; i < s.particles.size(); i += 5)
    leaving.push_back(static_cast<std::int32_t>(i));
  std::vector<std::int64_t> ids;
  for (const auto i : leaving)
    ids.push_back(s.particles.id[i]);
  using Entry = std::tuple<std::int64_t, std::int64_t, double, double>;
  const auto history = [&](const Simulation &of)
  {
    std::vector<Entry> entries;
    for (const TouchingContact &c : of.contacts.touching(of.particles))
    {
      const auto a = of.particles.id[c.first], b = of.particles.id[c.second];
      const auto leaves = [&](const std::int64_t id) { return std::find(ids.begin(), ids.end(), id) != ids.end(); };
      if (!leaves(a) && !leaves(b))
        entries.emplace_back(std::min(a, b), std::max(a, b), c.state.overlap, c.state.forces.tangential.norm());
    }
    std::sort(entries.begin(), entries.end());
    return entries;
  };
  const auto old_history = history(s);
  const std::size_t n = s.particles.size();
  const Exchange gone = s.remove(leaving);
  CHECK(gone.ids == ids);
  CHECK(s.particles.size() == n - ids.size());
  CHECK_NOTHROW(s.particles.check(s.parameters().materials.size()));
  CHECK(history(s) == old_history);
  CHECK(old_history.size() > 10);
  const GrainEnergy e = s.energy();
  CHECK(std::abs(e.balance() - before) < 1e-9 * e.gravity_work);
  s.integrate();

  Particles more;
  more.add(bent().scaled(0.4e-3), 2650., Vec3(1e-3, 1e-3, 5.2e-3), Quaternion::Identity());
  more.add(Superquadric{Vec3::Constant(0.4e-3), 1., 1.}, 2650., Vec3(1e-3, 3e-3, 5.2e-3), Quaternion::Identity());
  const Exchange come = s.add(more);
  CHECK(come.n_particles == 2);
  CHECK_NOTHROW(s.particles.check(s.parameters().materials.size()));
  const auto i = s.index_of(come.ids[0]);
  CHECK(s.particles.first_part[i + 1] - s.particles.first_part[i] == 3);
  CHECK((s.particles.part_position(s.particles.first_part[i]) - more.part_position(0)).norm() < 1e-15);
  CHECK(overlaps(more) == 0);
  run(s, 200);
  CHECK(s.particles.size() == n - ids.size() + 2);
}
