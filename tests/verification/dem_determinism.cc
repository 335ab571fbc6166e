#include "dem/io/snapshot.h"
#include "dem/packing/compression.h"
#include "dem/packing/distribution.h"
#include "dem/packing/random_addition.h"
#include "dem/simulation.h"

#include "tests/threads.h"
#include <algorithm>

#include "tests/temporary_folder.h"

#include <catch2/catch.hpp>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <memory>
#include <omp.h>
#include <random>
#include <utility>
#include <vector>

using namespace bergamo::dem;

namespace
{

/// FNV-1a over the bytes of an array of plain data.
class Hash
{
public:
  template <class T>
  Hash &add(const std::vector<T> &values)
  {
    const auto *bytes = reinterpret_cast<const unsigned char *>(values.data());
    for (std::size_t i = 0; i < values.size() * sizeof(T); ++i)
      value = (value ^ bytes[i]) * 1099511628211u;
    return *this;
  }
  std::uint64_t value = 14695981039346656037u;
};

std::uint64_t hash_of(const Simulation &s)
{
  Hash hash;
  const Particles &p = s.particles;
  hash.add(p.id).add(p.position).add(p.orientation).add(p.velocity).add(p.angular_momentum).add(p.angular_velocity);
  hash.add(p.force).add(p.torque).add(p.motion);
  hash.add(s.pairs.list.first).add(s.pairs.list.second).add(s.pairs.state).add(s.pairs.rest_until);
  hash.add(s.wall_contacts.particle)
      .add(s.wall_contacts.wall)
      .add(s.wall_contacts.state)
      .add(s.wall_contacts.rest_until);
  hash.add(s.walls);
  hash.add(std::vector<double>{s.time, s.pairs.losses.friction, s.pairs.losses.viscous, s.wall_contacts.losses.friction,
                               s.wall_contacts.losses.viscous});
  return hash.value;
}

/// Soft grains, so that a few thousand steps make a packing.
SimulationParameters soft_parameters()
{
  SimulationParameters p;
  p.grain = {1e8, 0.2, 2650.};
  p.wall = p.grain;
  p.friction = 0.3;
  p.wall_friction = 0.1;
  p.damping_ratio = 0.5;
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
  return Simulation(p, add_at_random(grains, box, p.grain.density, generator), box_walls(box));
}

std::size_t n_touching(const std::vector<ContactState> &states)
{
  return std::count_if(states.begin(), states.end(), [](const ContactState &s) { return s.touching != 0.; });
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
    loose_hashes.push_back(hash_of(loose));

    Simulation simulation = dense;
    Compression compression = dense_compression;
    for (int i = 0; i < 300; ++i)
      compression.step(simulation);
    hashes.push_back(hash_of(simulation));
    CHECK(simulation.n_rebuilds > dense.n_rebuilds);
    // The comparison is worth something only if there were grains, contacts and renewed neighbours.
    CHECK(simulation.particles.size() >= 180);
    CHECK(n_touching(simulation.pairs.state) > 150);
    CHECK(n_touching(simulation.wall_contacts.state) > 20);
    CHECK(simulation.n_rebuilds > 20);
    CHECK(simulation.pairs.n_undecided == 0);
  }
  for (const std::uint64_t hash : hashes)
    CHECK(hash == hashes.front());
  for (const std::uint64_t hash : loose_hashes)
    CHECK(hash == loose_hashes.front());
  CHECK(hashes.front() != loose_hashes.front());
}

TEST_CASE("a restart goes on with the same bits")
{
  const Threads threads(1); // a team costs more than it gains on 200 grains
  Simulation straight = loose_packing(soft_parameters());
  Compression compression(fast_compression());
  for (int i = 0; i < 1000; ++i)
    compression.step(straight);
  SimulationParameters rougher = soft_parameters();
  rougher.friction = 0.7;
  straight.change(rougher);

  const TemporaryFolder folder;
  ArchiveWriter writer(folder / "snapshot.h5", "restart test");
  write_simulation(writer, straight);
  writer.commit();
  const auto restarted = read_simulation(ArchiveReader(folder / "snapshot.h5", "restart test"), soft_parameters());
  Compression resumed(fast_compression());
  resumed.n_checks_passed = compression.n_checks_passed;
  resumed.unbalance = compression.unbalance;

  CHECK(hash_of(*restarted) == hash_of(straight));
  for (int i = 0; i < 1000; ++i)
  {
    compression.step(straight);
    resumed.step(*restarted);
  }
  CHECK(n_touching(straight.pairs.state) > 150);
  CHECK(hash_of(*restarted) == hash_of(straight));
  CHECK(restarted->n_steps == 2000);
  CHECK(restarted->n_rebuilds == straight.n_rebuilds);
  CHECK(restarted->pairs.n_searches == straight.pairs.n_searches);
  restarted->compute_forces();
  straight.compute_forces();
  CHECK(restarted->energy().balance() == straight.energy().balance());
}

TEST_CASE("sorting and renewing the neighbours keeps every contact's history")
{
  const Threads threads(1); // a team costs more than it gains on 200 grains
  SimulationParameters lazy = soft_parameters();
  lazy.contact.overlap_tolerance = 0.01; // so that contacts carry some motion and spin since their last search
  Simulation simulation = loose_packing(lazy);
  Compression compression(fast_compression());
  for (int i = 0; i < 2000; ++i)
    compression.step(simulation);

  // The history of each touching pair by the ids of its grains, in the sense from the first to the second.
  using History = std::map<std::pair<std::int64_t, std::int64_t>, ContactState>;
  const auto history_of = [](const Simulation &s)
  {
    History h;
    for (std::size_t k = 0; k < s.pairs.state.size(); ++k)
      if (s.pairs.state[k].touching != 0.)
        h[{s.particles.id[s.pairs.list.first[k]], s.particles.id[s.pairs.list.second[k]]}] = s.pairs.state[k];
    return h;
  };
  const auto wall_history_of = [](const Simulation &s)
  {
    History h;
    for (std::size_t k = 0; k < s.wall_contacts.size(); ++k)
      if (s.wall_contacts.state[k].touching != 0.)
        h[{s.particles.id[s.wall_contacts.particle[k]], s.wall_contacts.wall[k]}] = s.wall_contacts.state[k];
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

  int n_exchanged = 0, n_spinning = 0;
  for (const auto &[ids_of_pair, s] : before)
  {
    // Seen from the other body the normal, the tangential force and the rotation about the normal turn round; point,
    // overlap and losses stay.
    const auto same = after.find(ids_of_pair), other = after.find({ids_of_pair.second, ids_of_pair.first});
    REQUIRE((same != after.end() || other != after.end()));
    const bool is_exchanged = same == after.end();
    const double sign = is_exchanged ? -1. : 1.;
    const ContactState &n = is_exchanged ? other->second : same->second;
    n_exchanged += is_exchanged;
    n_spinning += is_exchanged && s.spin != 0.;
    CHECK(n.normal == sign * s.normal);
    CHECK(n.tangential_force == sign * s.tangential_force);
    CHECK(n.spin == sign * s.spin);
    CHECK(n.point == s.point);
    CHECK(n.overlap == s.overlap);
    CHECK(n.normal_force == s.normal_force);
    CHECK(n.motion == s.motion);
    CHECK(n.friction_loss == s.friction_loss);
    CHECK(n.viscous_loss == s.viscous_loss);
    CHECK(n.weight == s.weight);
  }
  CHECK(n_exchanged > 10);
  CHECK(n_spinning > 10);
  for (const auto &[key, s] : walls_before)
  {
    const auto found = walls_after.find(key);
    REQUIRE(found != walls_after.end());
    CHECK(found->second.tangential_force == s.tangential_force);
    CHECK(found->second.overlap == s.overlap);
    CHECK(found->second.friction_loss == s.friction_loss);
  }

  // The next step gives the same forces, summed in another order: rounding of the largest force.
  sorted.compute_forces();
  simulation.compute_forces();
  double largest = 0.;
  for (const Vec3 &f : simulation.particles.force)
    largest = std::max(largest, f.norm());
  for (std::size_t i = 0; i < simulation.particles.size(); ++i)
  {
    const auto j = sorted.index_of_id[simulation.particles.id[i]];
    CHECK((sorted.particles.force[j] - simulation.particles.force[i]).norm() < 1e-9 * largest);
  }
  // Sorting changes no account.
  CHECK(sorted.pairs.total_losses().friction == Approx(simulation.pairs.total_losses().friction).epsilon(1e-12));
  CHECK(sorted.pairs.total_losses().viscous == Approx(simulation.pairs.total_losses().viscous).epsilon(1e-12));
}

TEST_CASE("the Verlet distance changes the work but not the forces")
{
  const Threads threads(1); // a team costs more than it gains on 200 grains
  // Lists of different ranges hold the same touching pairs; histories must survive a hundred renewals. Bits are the
  // same until a pair that left the list and came back is searched from the centre line instead of its old normal: its
  // rounding differs, 1e-18 m, and collisions make a tenfold of it some six times in 600 steps. A lost history would
  // show at 1e-8 m.
  std::vector<Simulation> runs;
  for (const double distance : {0.02, 0.5})
  {
    SimulationParameters p = soft_parameters();
    p.verlet_distance = distance;
    runs.push_back(loose_packing(p));
    Compression compression(fast_compression());
    for (int i = 0; i < 600; ++i)
      compression.step(runs.back());
  }
  CHECK(runs[0].n_rebuilds > 5 * runs[1].n_rebuilds);
  CHECK(runs[0].n_rebuilds > 80);
  CHECK(n_touching(runs[0].pairs.state) == n_touching(runs[1].pairs.state));
  CHECK(n_touching(runs[0].pairs.state) > 20);
  for (std::int64_t id = 0; id < static_cast<std::int64_t>(runs[0].particles.size()); ++id)
  {
    const Vec3 a = runs[0].particles.position[runs[0].index_of_id[id]],
               b = runs[1].particles.position[runs[1].index_of_id[id]];
    CHECK((a - b).norm() < 1e-9 * box_edge);
  }
}
