#include "dem/force/load_sums.h"

#include <catch2/catch.hpp>
#include <cmath>
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
