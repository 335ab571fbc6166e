#include "dem/force/load_sums.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

using namespace bergamo;
using namespace bergamo::dem;

TEST_CASE("loads summed by chunks are the sums over all contacts, also after bodies have run out of room")
{
  // Numbers are integers, so that sums are exact in any order.
  constexpr int n_bodies = 300, n_slots = 2 * slots_per_chunk + 5 * pack_width;
  std::mt19937 generator(1);
  std::uniform_int_distribution<int> near(0, 30), number(-9, 9), any(0, n_bodies - 1);
  std::vector<std::int32_t> first, second;
  for (int slot = 0; slot < n_slots; ++slot)
  {
    first.push_back(std::min(slot / 8, n_bodies - 40));
    second.push_back(first.back() + 1 + near(generator));
  }
  LoadSums sums;
  CHECK_FALSE(sums.is_current());
  sums.list_bodies(first, second, n_bodies);
  std::vector<Vec3> force(n_bodies, Vec3::Zero()), torque = force;
  const auto add = [&](const std::int32_t slot)
  {
    const auto draw = [&] { return Vec3(number(generator), number(generator), number(generator)); };
    const Resultant r{draw(), draw(), draw()};
    sums.add(slot, r);
    force[first[slot]] += r.force;
    force[second[slot]] -= r.force;
    torque[first[slot]] += r.torque1;
    torque[second[slot]] += r.torque2;
  };
  for (std::size_t chunk = 0; chunk < sums.n_chunks(); ++chunk)
    sums.start(chunk);
  for (int slot = 0; slot < n_slots; ++slot)
    add(slot);
  int n_relisted = 0;
  for (int k = 0; k < 2000; ++k) // other bodies take slots
  {
    const int slot = any(generator);
    first[slot] = any(generator);
    second[slot] = (first[slot] + 1) % n_bodies;
    sums.take(slot, first[slot], second[slot]);
    if (!sums.is_current())
    {
      sums.list_bodies(first, second, n_bodies);
      ++n_relisted;
    }
    add(slot);
  }
  CHECK(n_relisted > 0);
  // A body that has left a chunk for good loses there only what it had summed before: start anew.
  for (auto *values : {&force, &torque})
    values->assign(n_bodies, Vec3::Zero());
  for (std::size_t chunk = 0; chunk < sums.n_chunks(); ++chunk)
    sums.start(chunk);
  for (int slot = 0; slot < n_slots; ++slot)
    add(slot);
  for (int i = 0; i < n_bodies; ++i)
  {
    BodyLoad load;
    sums.add_load(i, load);
    CHECK(load.force.head<3>() == force[i]);
    CHECK(load.torque.head<3>() == torque[i]);
  }
}

namespace
{

/// Contacts of neighbouring bodies and some of far ones, by slot, and what each gives.
struct DealtContacts
{
  static constexpr int n_bodies = 520, n_slots = 8 * slots_per_chunk;
  std::vector<std::int32_t> first, second;
  std::vector<Resultant> resultant;

  DealtContacts()
  {
    std::mt19937 generator(3);
    std::uniform_int_distribution<int> near(1, 20), far(1, n_bodies - 1);
    std::normal_distribution<double> number;
    const auto draw = [&] { return Vec3(number(generator), number(generator), number(generator)); };
    for (int slot = 0; slot < n_slots; ++slot)
    {
      first.push_back(slot / 8);
      second.push_back((first.back() + (slot % 4 == 0 ? far : near)(generator)) % n_bodies);
      resultant.push_back({draw(), draw(), draw()});
    }
  }

  /// A step: the followed contacts by blocks, then, by slots, those that were due for a search.
  void add_to(LoadSums &sums) const
  {
    const auto is_due = [](const int slot) { return slot % 7 == 0; };
    for (std::size_t chunk = 0; chunk < sums.n_chunks(); ++chunk)
      sums.start(chunk);
    for (int block = 0; block < n_slots / pack_width; ++block)
    {
      const auto packed = [&](Vec3 Resultant::*part)
      {
        const auto number = [&](const int d)
        {
          return math::generate<Pack>(
              [&](const int lane)
              {
                const int slot = block * pack_width + lane;
                return is_due(slot) ? 0. : (resultant[slot].*part)[d];
              });
        };
        return Vector3<Pack>(number(0), number(1), number(2));
      };
      sums.add(block, packed(&Resultant::force), packed(&Resultant::torque1), packed(&Resultant::torque2));
    }
    for (int slot = 0; slot < n_slots; ++slot)
      if (is_due(slot))
        sums.add(slot, resultant[slot]);
  }

  /// The same contacts in slots drawn anew.
  DealtContacts dealt_anew() const
  {
    std::vector<int> from(n_slots);
    std::iota(from.begin(), from.end(), 0);
    std::shuffle(from.begin(), from.end(), std::mt19937(4));
    DealtContacts other = *this;
    for (int slot = 0; slot < n_slots; ++slot)
    {
      other.first[slot] = first[from[slot]];
      other.second[slot] = second[from[slot]];
      other.resultant[slot] = resultant[from[slot]];
    }
    return other;
  }
};

std::vector<BodyLoad> loads_of_bodies(const LoadSums &sums)
{
  std::vector<BodyLoad> loads(DealtContacts::n_bodies);
  for (int i = 0; i < DealtContacts::n_bodies; ++i)
    sums.add_load(i, loads[i]);
  return loads;
}

} // namespace

TEST_CASE("sums of loads have the bits that the contacts' slots give, however the contacts came into them")
{
  // A restart lists the bodies of all slots at once; the run before it gave the slots to one contact after another.
  const DealtContacts contacts;
  LoadSums listed, taken;
  listed.list_bodies(contacts.first, contacts.second, DealtContacts::n_bodies);
  contacts.add_to(listed);
  const std::vector<BodyLoad> expected = loads_of_bodies(listed);

  // The last eighth of every other chunk begins with contacts that the chunk has already; those that come bring bodies
  // that are new to it and known to earlier chunks and later ones.
  std::vector<std::int32_t> first = contacts.first, second = contacts.second, slots;
  for (int slot = 0; slot < DealtContacts::n_slots; ++slot)
    if (slot % (2 * slots_per_chunk) >= slots_per_chunk / 8 * 15)
    {
      first[slot] = contacts.first[slot - slots_per_chunk / 2];
      second[slot] = contacts.second[slot - slots_per_chunk / 2];
      slots.push_back(slot);
    }
  taken.list_bodies(first, second, DealtContacts::n_bodies);
  std::shuffle(slots.begin(), slots.end(), std::mt19937(5));
  for (const std::int32_t slot : slots)
    taken.take(slot, contacts.first[slot], contacts.second[slot]);
  REQUIRE(taken.is_current());
  contacts.add_to(taken);
  const std::vector<BodyLoad> loads = loads_of_bodies(taken);
  for (int i = 0; i < DealtContacts::n_bodies; ++i)
  {
    CHECK(loads[i].force.head<3>() == expected[i].force.head<3>());
    CHECK(loads[i].torque.head<3>() == expected[i].torque.head<3>());
  }
}

TEST_CASE("contacts dealt out to other slots and chunks give the same loads but for rounding")
{
  // Sums of n numbers in any two orders differ by at most n eps times the sum of magnitudes.
  const DealtContacts contacts, others = contacts.dealt_anew();
  std::vector<Vec3> force(DealtContacts::n_bodies, Vec3::Zero()), torque = force; // magnitudes
  std::vector<int> n(DealtContacts::n_bodies, 0);
  for (int slot = 0; slot < DealtContacts::n_slots; ++slot)
    for (const bool is_first : {true, false})
    {
      const Resultant &r = contacts.resultant[slot];
      const std::int32_t body = is_first ? contacts.first[slot] : contacts.second[slot];
      force[body] += r.force.cwiseAbs();
      torque[body] += (is_first ? r.torque1 : r.torque2).cwiseAbs();
      ++n[body];
    }
  std::vector<std::vector<BodyLoad>> loads;
  for (const DealtContacts *dealt : {&contacts, &others})
  {
    LoadSums sums;
    sums.list_bodies(dealt->first, dealt->second, DealtContacts::n_bodies);
    dealt->add_to(sums);
    loads.push_back(loads_of_bodies(sums));
  }
  constexpr double eps = std::numeric_limits<double>::epsilon();
  for (int i = 0; i < DealtContacts::n_bodies; ++i)
    for (int d = 0; d < 3; ++d)
    {
      CHECK(std::abs(loads[0][i].force[d] - loads[1][i].force[d]) <= n[i] * eps * force[i][d]);
      CHECK(std::abs(loads[0][i].torque[d] - loads[1][i].torque[d]) <= n[i] * eps * torque[i][d]);
    }
}

TEST_CASE("one over the square root is right to 2 ulp")
{
  std::mt19937 generator(2);
  std::uniform_real_distribution<double> exponent(-300., 300.);
  double worst = 0.;
  for (int k = 0; k < 20000; ++k)
  {
    const double x = std::pow(10., exponent(generator));
    const double exact = 1. / std::sqrt(x), packed = math::lane(math::inverse_sqrt(Pack(x)), 0);
    worst = std::max(worst, std::abs(packed - exact) / exact);
  }
  CHECK(worst <= 2. * 2.3e-16);
}
