#include "dem/io/snapshot.h"
#include "dem/loading/compression.h"
#include "dem/packing/grading.h"
#include "dem/packing/random_addition.h"
#include "dem/simulation/simulation.h"

#include "tests/threads.h"
#include <algorithm>

#include "tests/temporary_folder.h"

#include <catch2/catch.hpp>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <memory>
#include <numeric>
#include <omp.h>
#include <random>
#include <utility>
#include <vector>

using namespace bergamo;
using namespace bergamo::dem;

namespace
{

/// Of all that a step depends on or leaves behind, but for the identities of the grains.
std::uint64_t hash_without_ids(Simulation s)
{
  std::fill(s.particles.id.begin(), s.particles.id.end(), 0);
  return state_hash(s);
}

/// Soft grains, so that a few thousand steps make a packing.
SimulationParameters soft_parameters()
{
  SimulationParameters p;
  p.grain() = {1e8, 0.2, 2650.};
  p.wall() = p.grain();
  p.between_grains().friction = 0.3;
  p.with_walls().friction = 0.1;
  p.set_damping(0.5);
  p.time_step = 4e-6;
  return p;
}

CompressionParameters fast_compression()
{
  CompressionParameters c;
  c.largest_rate = 100.;
  c.longest_time = 10.;
  return c;
}

constexpr double box_edge = 6.4e-3;

Simulation loose_packing(const SimulationParameters &p)
{
  std::mt19937_64 generator(1);
  const Box box{Vec3::Zero(), Vec3::Constant(box_edge)};
  const auto grains = draw_grains({}, 0.24 * box.volume(), generator);
  return Simulation(p, add_at_random(grains, box, p.grain().density, generator()), box_walls(box));
}

/// Grains that a tilted gravity pours onto the floor and into a corner of a box, where they settle: every other one is
/// a sphere, so that all kinds of contacts occur.
struct Pouring
{
  SimulationParameters parameters = soft_parameters();
  Box box{Vec3::Zero(), Vec3::Constant(9.2e-3)};
  Particles grains;

  Pouring()
  {
    parameters.grain().young_modulus = 1e7;
    parameters.wall() = parameters.grain();
    parameters.time_step = 1e-5;
    parameters.gravity = Vec3(4., 2., -9.);
    std::mt19937_64 generator(1);
    auto shapes = draw_grains({}, 0.24 * box.volume(), generator);
    for (std::size_t i = 0; i < shapes.size(); i += 2)
      shapes[i] = {Vec3::Constant(equivalent_radius(shapes[i])), 1., 1.};
    grains = add_at_random(shapes, box, parameters.grain().density, generator());
  }

  Simulation begin() const { return Simulation(parameters, grains, box_walls(box)); }

  static constexpr int n_steps = 10000;

  /// Half way the friction is changed, upon which all contacts are searched in one step.
  void go_on(Simulation &s, const int last_step) const
  {
    while (s.n_steps < last_step)
    {
      if (s.n_steps == n_steps / 2)
      {
        SimulationParameters rougher = parameters;
        rougher.between_grains().friction = 0.5;
        s.change(rougher);
      }
      s.step();
    }
  }
};

/// What one run of the pouring leaves.
struct Outcome
{
  std::uint64_t middle, end; ///< hashes
  std::vector<std::int64_t> ids;
};

/// The run on one thread, by which the others are judged; made once.
const Outcome &pouring_on_one_thread()
{
  static const Outcome outcome = []
  {
    const Threads threads(1);
    const Pouring pouring;
    Simulation s = pouring.begin();
    pouring.go_on(s, Pouring::n_steps / 2);
    const double kinetic = s.energy().kinetic;
    const auto touching_walls = s.contacts.n_touching_walls();
    const std::uint64_t middle = hash_without_ids(s);
    pouring.go_on(s, Pouring::n_steps);
    // The grains flowed and came to rest, in contacts of all kinds, without undecided searches.
    CHECK(s.n_rebuilds() > 50);
    CHECK(s.energy().kinetic < 0.1 * kinetic);
    CHECK(s.energy().friction_loss > 0.);
    CHECK(s.contacts.n_undecided() == 0);
    // Several threads take part in the parallel loops, that is where there are two parts of the least size: 128 grains
    // or 16 packs of them, 128 packs of pairs, two groups of searches, two chunks of 16 wall contacts (all those that
    // touch, where the friction is changed). Of touching contacts there is one chunk here, and there are
    // several in the case above.
    CHECK(s.particles.size() >= 16 * pack_width);
    CHECK(s.contacts.n_candidates() > 128 * pack_width);
    CHECK(touching_walls > 16);
    CHECK(s.contacts.n_searches() > static_cast<std::int64_t>(GrainGrain::search_group) * s.n_steps);
    return Outcome{middle, hash_without_ids(s), s.particles.id};
  }();
  return outcome;
}

} // namespace

TEST_CASE("a packing under compression has the same bits on 1, 2, 3 and 8 threads")
{
  // Steps 0 to 300 from the loose packing, without contacts at first, and 1700 to 2000 of the dense one, whose first
  // 1700 run on one thread for the sake of time.
  Simulation dense = loose_packing(soft_parameters());
  Compression dense_compression(fast_compression());
  {
    const Threads threads(1);
    for (int i = 0; i < 1700; ++i)
      dense_compression.step(dense);
  }
  std::vector<std::uint64_t> loose_hashes, hashes;
  for (const int n : {1, 2, 3, 8})
  {
    const Threads threads(n);
    Simulation loose = loose_packing(soft_parameters());
    Compression loose_compression(fast_compression());
    for (int i = 0; i < 300; ++i)
      loose_compression.step(loose);
    loose_hashes.push_back(state_hash(loose));

    Simulation simulation = dense;
    Compression compression = dense_compression;
    for (int i = 0; i < 300; ++i)
      compression.step(simulation);
    hashes.push_back(state_hash(simulation));
    CHECK(simulation.n_rebuilds() > dense.n_rebuilds());
    // The comparison is worth something only if there were grains, contacts and renewed neighbours.
    CHECK(simulation.particles.size() >= 180);
    CHECK(simulation.contacts.n_touching() > 150);
    CHECK(simulation.contacts.n_touching_walls() > 20);
    CHECK(simulation.n_rebuilds() > 20);
    CHECK(simulation.contacts.n_undecided() == 0);
  }
  for (const std::uint64_t hash : hashes)
    CHECK(hash == hashes.front());
  for (const std::uint64_t hash : loose_hashes)
    CHECK(hash == loose_hashes.front());
  CHECK(hashes.front() != loose_hashes.front());
}

TEST_CASE("many chunks of contacts have the same bits on 1, 2, 3 and 8 threads")
{
  // Grains in rows that overlap, every other one a sphere, fly apart and into one another: contacts of all kinds begin
  // and end in some chunks of slots each.
  constexpr int n_side = 11;
  constexpr double radius = 0.5e-3;
  Particles grains;
  std::mt19937_64 generator(7);
  std::normal_distribution<double> normal;
  for (int i = 0; i < n_side * n_side * n_side; ++i)
  {
    const double exponent = (i / 2) % 2 == 0 ? 1. : 0.8;
    grains.add({Vec3::Constant(radius), exponent, exponent}, 2650.,
               1.99 * radius * Vec3(i % n_side, i / n_side % n_side, i / (n_side * n_side)), Quaternion::Identity());
    grains.velocity.back() = 1. * Vec3(normal(generator), normal(generator), normal(generator));
  }
  SimulationParameters parameters = soft_parameters();
  const Box box{Vec3::Constant(-0.995 * radius), Vec3::Constant(1.99 * radius * (n_side - 0.5))};
  std::vector<std::uint64_t> hashes;
  for (const int n : {1, 2, 3, 8})
  {
    const Threads threads(n);
    Simulation s(parameters, grains, box_walls(box));
    for (int i = 0; i < 150; ++i)
      s.step();
    CHECK(s.contacts.grain_grain[0].touching().n_chunks() > 1);
    CHECK(s.contacts.sphere_sphere[0].touching().n_chunks() > 0);
    CHECK(s.n_rebuilds() > 1);
    hashes.push_back(state_hash(s));
  }
  for (const std::uint64_t hash : hashes)
    CHECK(hash == hashes.front());
}

TEST_CASE("10 000 steps of pouring grains have the same bits on 1, 2, 3 and 8 threads")
{
  const Outcome &one = pouring_on_one_thread();
  for (const int n : {2, 3, 8})
  {
    const Threads threads(n);
    const Pouring pouring;
    Simulation s = pouring.begin();
    pouring.go_on(s, Pouring::n_steps / 2);
    CAPTURE(n);
    CHECK(hash_without_ids(s) == one.middle);
    if (n > 2) // more threads than processors mostly wait
      continue;
    pouring.go_on(s, Pouring::n_steps);
    CHECK(hash_without_ids(s) == one.end);
    CHECK(s.particles.id == one.ids);
  }
}

TEST_CASE("pouring grains have the same bits across a restart in the middle")
{
  const Outcome &one = pouring_on_one_thread();
  const Threads threads(1);
  const Pouring pouring;
  Simulation s = pouring.begin();
  pouring.go_on(s, Pouring::n_steps / 2);
  const TemporaryFolder folder;
  ArchiveWriter writer(folder / "snapshot.h5", "restart test");
  write_simulation(writer, s);
  writer.commit();
  const auto restarted = read_simulation(ArchiveReader(folder / "snapshot.h5", "restart test"), pouring.parameters);
  CHECK(hash_without_ids(*restarted) == one.middle);
  pouring.go_on(*restarted, Pouring::n_steps);
  CHECK(hash_without_ids(*restarted) == one.end);
  CHECK(restarted->particles.id == one.ids);
}

TEST_CASE("pouring grains have the same bits in whatever order they came")
{
  const Outcome &one = pouring_on_one_thread();
  const Threads threads(1);
  Pouring pouring;
  const Particles grains = std::exchange(pouring.grains, Particles());
  std::vector<std::size_t> came(grains.size()); // place in the first order by id in the second
  std::iota(came.begin(), came.end(), 0);
  std::mt19937_64 generator(2);
  std::shuffle(came.begin(), came.end(), generator);
  for (const std::size_t i : came)
  {
    pouring.grains.add(grains.parts.shape[i], pouring.parameters.grain().density, grains.position[i],
                       grains.orientation[i]);
    pouring.grains.orientation.back() = grains.orientation[i]; // not normalised once more
  }
  Simulation s = pouring.begin();
  pouring.go_on(s, Pouring::n_steps / 2);
  CHECK(hash_without_ids(s) == one.middle);
  pouring.go_on(s, Pouring::n_steps);
  CHECK(hash_without_ids(s) == one.end);
  std::vector<std::int64_t> first_ids;
  for (const std::int64_t id : s.particles.id)
    first_ids.push_back(static_cast<std::int64_t>(came[id]));
  CHECK(first_ids == one.ids);
}

TEST_CASE("a restart goes on with the same bits")
{
  const Threads threads(1); // a team costs more than it gains on 200 grains
  Simulation straight = loose_packing(soft_parameters());
  Compression compression(fast_compression());
  for (int i = 0; i < 1000; ++i)
    compression.step(straight);
  SimulationParameters rougher = soft_parameters();
  rougher.between_grains().friction = 0.7;
  straight.change(rougher);

  const TemporaryFolder folder;
  ArchiveWriter writer(folder / "snapshot.h5", "restart test");
  write_simulation(writer, straight);
  writer.commit();
  const auto restarted = read_simulation(ArchiveReader(folder / "snapshot.h5", "restart test"), soft_parameters());
  Compression resumed(fast_compression());
  resumed.n_checks_passed = compression.n_checks_passed;
  resumed.unbalance = compression.unbalance;

  CHECK(state_hash(*restarted) == state_hash(straight));
  for (int i = 0; i < 1000; ++i)
  {
    compression.step(straight);
    resumed.step(*restarted);
  }
  CHECK(straight.contacts.n_touching() > 150);
  CHECK(state_hash(*restarted) == state_hash(straight));
  CHECK(restarted->n_steps == 2000);
  CHECK(restarted->n_rebuilds() == straight.n_rebuilds());
  CHECK(restarted->contacts.n_searches() == straight.contacts.n_searches());
  restarted->compute_forces();
  straight.compute_forces();
  CHECK(restarted->energy().balance() == straight.energy().balance());
}

TEST_CASE("sorting and renewing the neighbours keeps every contact's history")
{
  const Threads threads(1); // a team costs more than it gains on 200 grains
  SimulationParameters lazy = soft_parameters();
  lazy.contact.overlap_tolerance = 0.01; // so that contacts carry some motion since their last search
  lazy.sort_interval = 1000000;          // never before the end, so that the grains have left their order by then
  Simulation simulation = loose_packing(lazy);
  Compression compression(fast_compression());
  for (int i = 0; i < 2000; ++i)
    compression.step(simulation);

  // The history of each touching pair by the ids of its grains, in the sense from the first to the second.
  using History = std::map<std::pair<std::int64_t, std::int64_t>, ContactView>;
  const auto history_of = [](const Simulation &s)
  {
    History h;
    for (const TouchingContact &contact : s.contacts.touching(s.particles))
      h.emplace(std::pair(s.particles.id[contact.first], s.particles.id[contact.second]), contact.state);
    return h;
  };
  const auto wall_history_of = [](const Simulation &s)
  {
    History h;
    for (const TouchingContact &contact : s.contacts.touching_walls(s.particles))
      h.emplace(std::pair(s.particles.id[contact.first], contact.wall), contact.state);
    return h;
  };

  const History before = history_of(simulation), walls_before = wall_history_of(simulation);
  REQUIRE(before.size() > 150);
  Simulation sorted = simulation;
  const auto ids = sorted.particles.id;
  sorted.sort_by_place();
  REQUIRE(sorted.particles.id != ids); // the grains did move to other places
  const History after = history_of(sorted), walls_after = wall_history_of(sorted);
  REQUIRE(after.size() == before.size());
  REQUIRE(walls_after.size() == walls_before.size());

  int n_exchanged = 0;
  for (const auto &[ids_of_pair, s] : before)
  {
    // Seen from the other body the normal and the tangential force turn round; point
    // and overlap stay.
    const auto same = after.find(ids_of_pair), other = after.find({ids_of_pair.second, ids_of_pair.first});
    REQUIRE((same != after.end() || other != after.end()));
    const bool is_exchanged = same == after.end();
    const double sign = is_exchanged ? -1. : 1.;
    const ContactView &n = is_exchanged ? other->second : same->second;
    n_exchanged += is_exchanged;
    CHECK(n.normal == sign * s.normal);
    CHECK(n.forces.tangential == sign * s.forces.tangential);
    CHECK(n.point == s.point);
    CHECK(n.overlap == s.overlap);
    CHECK(n.forces.normal == s.forces.normal);
    CHECK(n.major_axis == s.major_axis);
    CHECK(n.weight == s.weight);
  }
  CHECK(n_exchanged > 10);
  for (const auto &[key, s] : walls_before)
  {
    const auto found = walls_after.find(key);
    REQUIRE(found != walls_after.end());
    CHECK(found->second.forces.tangential == s.forces.tangential);
    CHECK(found->second.overlap == s.overlap);
  }

  // The next step gives the same forces, summed in another order: rounding of the largest force.
  sorted.compute_forces();
  simulation.compute_forces();
  double largest = 0.;
  for (const Vec3 &f : simulation.particles.force)
    largest = std::max(largest, f.norm());
  for (std::size_t i = 0; i < simulation.particles.size(); ++i)
  {
    const auto j = sorted.index_of(simulation.particles.id[i]);
    CHECK((sorted.particles.force[j] - simulation.particles.force[i]).norm() < 1e-9 * largest);
  }
  // Sorting changes no account.
  CHECK(sorted.contacts.losses().friction == Approx(simulation.contacts.losses().friction).epsilon(1e-12));
  CHECK(sorted.contacts.losses().viscous == Approx(simulation.contacts.losses().viscous).epsilon(1e-12));
}

TEST_CASE("the Verlet distance changes the work but not the forces")
{
  const Threads threads(1); // a team costs more than it gains on 200 grains
  // Lists of different ranges hold the same touching pairs; histories must survive a hundred renewals. Every contact is
  // searched in every step, since one that is followed has the error allowed, not one of rounding. Bits are the same until a pair that left the list and came back is searched from the centre line instead of its old normal: its
  // rounding differs, 1e-18 m, and each collision of such a grain makes a tenfold of it, up to eight times in 600 steps
  // (1.6e-10 m was the most among six packings), so most grains agree far better. A lost history shows at 1e-8 m.
  std::vector<Simulation> runs;
  for (const double distance : {0.02, 0.5})
  {
    SimulationParameters p = soft_parameters();
    p.verlet_distance = distance;
    p.contact.overlap_tolerance = 0.;
    runs.push_back(loose_packing(p));
    Compression compression(fast_compression());
    for (int i = 0; i < 600; ++i)
      compression.step(runs.back());
  }
  CHECK(runs[0].n_rebuilds() > 5 * runs[1].n_rebuilds());
  CHECK(runs[0].n_rebuilds() > 80);
  CHECK(runs[0].contacts.n_touching() == runs[1].contacts.n_touching());
  CHECK(runs[0].contacts.n_touching() > 20);
  std::vector<double> differences;
  for (std::int64_t id = 0; id < static_cast<std::int64_t>(runs[0].particles.size()); ++id)
    differences.push_back(
        (runs[0].particles.position[runs[0].index_of(id)] - runs[1].particles.position[runs[1].index_of(id)]).norm());
  std::sort(differences.begin(), differences.end());
  CHECK(differences[differences.size() / 2] < 1e-9 * box_edge);
  CHECK(differences.back() < 1e-9);
}
