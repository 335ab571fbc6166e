#include "dem/geometry/rigid_clump.h"
#include "dem/neighbour/neighbour_watch.h"
#include "dem/simulation/simulation.h"
#include "tests/surfaces.h"
#include "tests/threads.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <random>
#include <set>
#include <utility>
#include <vector>

using namespace bergamo;
using namespace bergamo::dem;

namespace
{

Vec3 random_vector(std::mt19937_64 &generator)
{
  std::uniform_real_distribution<double> unit(-1., 1.);
  return {unit(generator), unit(generator), unit(generator)};
}

/// Grains of two sizes, spheres, fixed ones, and clumps if asked for, in a box of edge 6 with a floor and a surface,
/// each with a velocity of its own: many slow, some fast.
struct Crowd
{
  Particles particles;
  std::vector<PlaneWall> walls{{Vec3(0., 0., -3.), Vec3::UnitZ()}};
  std::vector<Surface> surfaces;
  std::vector<Vec3> velocity; ///< a step [m]

  Crowd(const bool with_clumps, const int seed)
  {
    std::mt19937_64 generator(seed);
    const Clump dumbbell(ClumpShape{{{Superquadric{Vec3::Constant(0.15), 1., 1.}, Vec3(0.12, 0., 0.)},
                                     {Superquadric{Vec3::Constant(0.12), 1., 1.}, Vec3(-0.12, 0., 0.)}}},
                         1e-3);
    for (int i = 0; i < 300; ++i)
    {
      const Quaternion turn = Quaternion(Eigen::AngleAxisd(i, random_vector(generator).normalized()));
      const Vec3 x = 3. * random_vector(generator);
      if (with_clumps && i % 3 == 0)
        particles.add(dumbbell, 1., x, turn);
      else if (i % 4 == 0)
        particles.add(Superquadric{Vec3::Constant(i % 20 == 0 ? 1. : 0.2), 1., 1.}, 1., x, turn);
      else
        particles.add(Superquadric{Vec3(0.2, 0.15, 0.1), 0.8, 1.2}, 1., x, turn);
      const double speed = i % 10 == 0 ? 0.02 : (i % 3 == 0 ? 0.004 : 0.0005);
      velocity.push_back(speed * random_vector(generator));
      if (i % 7 == 0)
      {
        particles.fix(particles.size() - 1);
        velocity.back().setZero();
      }
    }
    test::Surface grid = test::grid_surface(
        3, [](double, double) { return 0.; }, 0., generator);
    surfaces.emplace_back(grid.node, grid.topology.triangle);
  }

  /// One step: everything flies on, turns, and some go another way.
  void move(std::mt19937_64 &generator)
  {
    double most = 0.;
    for (std::size_t i = 0; i < particles.size(); ++i)
    {
      if (particles.is_fixed(i))
        continue;
      if (generator() % 50 == 0)
        velocity[i] = velocity[i].norm() * random_vector(generator).normalized();
      particles.position[i] += velocity[i];
      double arm = 0.;
      for (auto k = particles.first_part[i]; k < particles.first_part[i + 1]; ++k)
        arm = std::max(arm, particles.parts.place[k].norm());
      constexpr double angle = 0.01;
      if (arm > 0.)
        particles.orientation[i] = Quaternion(Eigen::AngleAxisd(angle, Vec3::UnitY())) * particles.orientation[i];
      most = std::max(most, velocity[i].norm() + arm * angle);
    }
    particles.largest_motion += most;
  }
};

/// All candidates of all kinds: kind, both partners.
using Candidates = std::vector<std::tuple<int, std::int32_t, std::int32_t>>;

Candidates candidates_of(const Contacts &contacts)
{
  Candidates all;
  int kind = 0;
  Contacts::for_each_kind(contacts,
                          [&](const char *, const auto &sets)
                          {
                            for (const auto &set : sets)
                            {
                              const VerletList &list = set.candidates();
                              for (std::size_t i = 0; i + 1 < list.row.size(); ++i)
                                for (auto k = list.row[i]; k < list.row[i + 1]; ++k)
                                {
                                  REQUIRE(list.first[k] == static_cast<std::int32_t>(i));
                                  all.emplace_back(kind, list.first[k], list.second[k]);
                                }
                            }
                            ++kind;
                          });
  return all;
}

/// Pairs of parts, and parts with the floor, whose bounding spheres overlap by now and that are not among candidates.
int n_missed(const Crowd &crowd, const Contacts &contacts)
{
  const Candidates all = candidates_of(contacts);
  std::set<std::pair<std::int32_t, std::int32_t>> pairs, with_floor;
  for (const auto &[kind, i, j] : all)
    if (kind < 2)
      pairs.emplace(i, j);
    else if (kind == 2)
      with_floor.emplace(i, j);
  const Particles &p = crowd.particles;
  const auto n = static_cast<std::int32_t>(p.parts.size());
  int missed = 0;
  for (std::int32_t i = 0; i < n; ++i)
  {
    const std::int32_t body = p.parts.particle[i];
    for (std::int32_t j = i + 1; j < n; ++j)
      if (const std::int32_t other = p.parts.particle[j];
          body != other && !(p.is_fixed(body) && p.is_fixed(other)) &&
          (p.part_position(i) - p.part_position(j)).norm() < p.parts.bounding_radius[i] + p.parts.bounding_radius[j])
        missed += !pairs.count({i, j});
    if (!p.is_fixed(body) && p.part_position(i)[2] + 3. < p.parts.bounding_radius[i])
      missed += !with_floor.count({i, 0});
  }
  return missed;
}

} // namespace

TEST_CASE("lists renewed for strayed particles alone are those of a renewal of all, and miss no pair")
{
  const Threads one_thread(1);
  for (const bool with_clumps : {false, true})
  {
    Crowd crowd(with_clumps, 3 + with_clumps);
    Particles &p = crowd.particles;
    std::mt19937_64 generator(5);
    NeighbourWatch watch;
    watch.verlet_distance = 0.1;
    Contacts contacts(MaterialTable({Material(), Material()}).n_pairs());
    contacts.renew(p, crowd.walls, crowd.surfaces, {watch.verlet_distance});
    watch.take_all(p, crowd.walls, crowd.surfaces);
    const Candidates at_first = candidates_of(contacts);
    for (const int kind : {0, 1, 2, 3}) // else some are not tested
      CHECK(std::any_of(at_first.begin(), at_first.end(), [&](const auto &c) { return std::get<0>(c) == kind; }));

    int n_renewals = 0, missed = 0;
    std::size_t n_strayed = 0;
    for (int step = 0; step < 300; ++step)
    {
      crowd.move(generator);
      if (watch.must_renew(p, crowd.walls, crowd.surfaces))
      {
        REQUIRE(!watch.must_renew_all(p, crowd.walls, crowd.surfaces));
        const std::vector<std::uint8_t> strayed = watch.take_strayed(p);
        const std::vector<Vec3> places = watch.part_places(p);
        contacts.renew(p, crowd.walls, crowd.surfaces, {watch.verlet_distance, places, strayed});
        ++n_renewals;
        n_strayed += std::count(strayed.begin(), strayed.end(), 1);
        Contacts anew(MaterialTable({Material(), Material()}).n_pairs());
        anew.renew(p, crowd.walls, crowd.surfaces, {watch.verlet_distance, places});
        CHECK(candidates_of(contacts) == candidates_of(anew));
      }
      if (step % 3 == 0)
        missed += n_missed(crowd, contacts);
    }
    CHECK(missed == 0);
    CHECK(n_renewals > 50);
    CHECK(n_strayed > 1000);
    CHECK(n_strayed < 0.3 * n_renewals * p.parts.size()); // the slow ones were left alone
    CHECK(candidates_of(contacts) != at_first);
  }
}

TEST_CASE("a wall that moves renews the lists as a whole")
{
  const Threads one_thread(1);
  Crowd crowd(false, 7);
  NeighbourWatch watch;
  watch.verlet_distance = 0.1;
  watch.take_all(crowd.particles, crowd.walls, crowd.surfaces);
  crowd.walls[0].motion += 0.04;
  CHECK(!watch.must_renew(crowd.particles, crowd.walls, crowd.surfaces));
  crowd.walls[0].motion += 0.02;
  CHECK(watch.must_renew(crowd.particles, crowd.walls, crowd.surfaces));
  CHECK(watch.must_renew_all(crowd.particles, crowd.walls, crowd.surfaces));
}

namespace
{

/// Grains in rows that overlap fly apart and back again, so that contacts end and begin wherever slots are free.
/// The lists reach so far that none is renewed meanwhile.
Simulation flying_rows()
{
  constexpr int n_side = 11;
  constexpr double radius = 0.5e-3;
  Particles grains;
  std::mt19937_64 generator(7);
  std::normal_distribution<double> normal;
  for (int i = 0; i < n_side * n_side * n_side; ++i)
  {
    grains.add({Vec3::Constant(radius), 0.8, 0.8}, 2650.,
               1.99 * radius * Vec3(i % n_side, i / n_side % n_side, i / (n_side * n_side)), Quaternion::Identity());
    grains.velocity.back() = 0.4 * Vec3(normal(generator), normal(generator), normal(generator));
  }
  SimulationParameters p;
  p.grain() = {1e8, 0.2, 2650.};
  p.wall() = p.grain();
  p.set_damping(0.5);
  p.time_step = 4e-6;
  p.verlet_distance = 2.;
  Simulation s(p, grains, {});
  const auto n_renewals = s.n_rebuilds();
  for (int i = 0; i < 70; ++i)
  {
    if (i == 35)
      for (Vec3 &velocity : s.particles.velocity)
        velocity = -velocity;
    s.step();
  }
  REQUIRE(s.n_rebuilds() == n_renewals);
  return s;
}

/// How often the next contact in the order of the pairs lies in another chunk.
std::size_t n_jumps(const ContactSet<GrainGrain> &set)
{
  std::vector<std::pair<std::int32_t, std::size_t>> contacts; // pair, chunk
  for (std::size_t slot = 0; slot < set.touching().n_slots(); ++slot)
    if (set.touching().pair[slot] != set.touching().free_slot)
      contacts.emplace_back(set.touching().pair[slot], slot / slots_per_chunk);
  std::sort(contacts.begin(), contacts.end());
  std::size_t n = 0;
  for (std::size_t k = 1; k < contacts.size(); ++k)
    n += contacts[k].second != contacts[k - 1].second;
  return n;
}

} // namespace

TEST_CASE("a renewal for strayed particles keeps every contact's history, and order among the contacts")
{
  const Threads one_thread(1);
  const Simulation s = flying_rows();
  const Particles &p = s.particles;
  const ContactSet<GrainGrain> &before = s.contacts.grain_grain[0];
  const std::size_t n_contacts = before.n_touching(), n_chunks = before.touching().n_chunks();
  REQUIRE(n_chunks > 1);
  const double range = 1.5 * p.bounding_radius[0];
  std::vector<std::uint8_t> sought(p.size());
  for (std::size_t i = 0; i < sought.size(); ++i)
    sought[i] = i % 5 == 0;

  Contacts all = s.contacts, some = s.contacts;
  all.renew(p, {}, {}, {range});
  some.renew(p, {}, {}, {.range = range, .sought = sought});
  const std::vector<TouchingContact> kept = some.touching(p), of_all = all.touching(p), old = s.contacts.touching(p);
  REQUIRE(kept.size() == old.size()); // what touches is near
  REQUIRE(of_all.size() == old.size());
  CHECK(candidates_of(some) != candidates_of(s.contacts));
  for (std::size_t k = 0; k < old.size(); ++k)
    for (const TouchingContact &now : {kept[k], of_all[k]})
    {
      CHECK(now.first == old[k].first);
      CHECK(now.second == old[k].second);
      CHECK(now.state.normal == old[k].state.normal);
      CHECK(now.state.overlap == old[k].state.overlap);
      CHECK(now.state.forces.tangential == old[k].state.forces.tangential);
    }

  // Slots are put in order where there is little of it left.
  CAPTURE(n_contacts, n_chunks, n_jumps(before));
  REQUIRE(n_jumps(before) > n_contacts / 8 + n_chunks);
  CHECK(n_jumps(some.grain_grain[0]) < n_chunks);
}
