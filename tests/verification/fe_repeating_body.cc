// Bodies that repeat themselves: no place of them is special. What holds for one that is shifted by an element, its own
// faces in the middle, and what a homogeneous deformation is in closed form.

#include "dem/core/error.h"
#include "fe_dealii/equilibrium/static_equilibrium.h"
#include "fe_dealii/explicit_body.h"
#include "fe_dealii/stable_step.h"
#include "tests/threads.h"

#include <deal.II/grid/tria.h>

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

using namespace bergamo;
using namespace bergamo::fe;
using Catch::Matchers::Contains;

namespace
{

constexpr ElasticParameters soil{.young_modulus = 2e7, .poisson_ratio = 0.2, .density = 1800};
constexpr std::array<unsigned int, 3> n{4, 3, 2}; // elements
constexpr std::array<double, 3> edges{0.4, 0.36, 0.3};

ExplicitBody box(const std::array<bool, 3> is_periodic, const double damping = 0)
{
  ExplicitBodyParameters parameters;
  parameters.material = LinearElastic(soil);
  parameters.damping = damping;
  ExplicitBody body = make_box_body({.maximum = edges, .subdivisions = n}, parameters);
  body.repeat(is_periodic);
  return body;
}

void step(ExplicitBody &body, const double dt)
{
  body.compute_internal_force();
  body.kick(dt);
  body.drift(dt);
}

/// Place of a node on the lattice, that of upper faces on the lower ones where the body repeats itself.
std::array<unsigned int, 3> lattice(const ExplicitBody &body, const std::size_t node, const unsigned int shift)
{
  std::array<unsigned int, 3> place{};
  for (std::size_t d = 0; d < 3; ++d)
  {
    place[d] = std::lround(body.node_position()[node][d] / edges[d] * n[d]);
    if (body.images().is_periodic()[d])
      place[d] = (place[d] + shift) % n[d];
  }
  return place;
}

/// A number in [-1, 1] for each place, component and purpose.
double random_at(const std::array<unsigned int, 3> &place, const unsigned int component, const unsigned int purpose)
{
  std::mt19937 generator(1 + component + 3 * (place[0] + 8 * (place[1] + 8 * (place[2] + 8 * purpose))));
  generator.discard(8);
  return std::uniform_real_distribution(-1., 1.)(generator);
}

/// The greatest difference of a body's displacements from those of one whose lattice starts elsewhere [m].
double difference(const ExplicitBody &body, const ExplicitBody &shifted, const unsigned int shift)
{
  double greatest = 0;
  for (std::size_t a = 0; a < body.n_nodes(); ++a)
    for (std::size_t b = 0; b < body.n_nodes(); ++b)
      if (lattice(body, a, 0) == lattice(shifted, b, shift))
        for (std::size_t i = 0; i < 3; ++i)
          greatest = std::max(greatest, std::abs(body.displacement()[3 * a + i] - shifted.displacement()[3 * b + i]));
  return greatest;
}

double greatest_displacement(const ExplicitBody &body)
{
  const auto u = body.displacement();
  return std::abs(
      *std::max_element(u.begin(), u.end(), [](const double a, const double b) { return std::abs(a) < std::abs(b); }));
}

/// Random velocities, left to themselves.
ExplicitBody thrown(const std::array<bool, 3> is_periodic, const unsigned int shift, const int n_steps)
{
  ExplicitBody body = box(is_periodic, 20.);
  for (std::size_t node = 0; node < body.n_nodes(); ++node)
    for (unsigned int i = 0; i < 3; ++i)
      body.velocity()[3 * node + i] = random_at(lattice(body, node, shift), i, 0);
  const double dt = 0.5 * stable_step(body).time_step;
  for (int k = 0; k < n_steps; ++k)
    step(body, dt);
  return body;
}

} // namespace

TEST_CASE("nothing tells where a body that repeats itself has its faces")
{
  for (const std::array<bool, 3> is_periodic :
       {std::array{true, true, true}, std::array{true, false, false}, std::array{false, true, true}})
  {
    const ExplicitBody body = thrown(is_periodic, 0, 200), shifted = thrown(is_periodic, 1, 200);
    REQUIRE(greatest_displacement(body) > 1e-4);
    CHECK(difference(body, shifted, 1) < 1e-12 * greatest_displacement(body));
  }
}

TEST_CASE("images move alike, and what they exert on one another neither pushes nor works")
{
  ExplicitBody body = box({true, true, true});
  std::array<double, 3> momentum{};
  double mass = 0;
  for (std::size_t node = 0; node < body.n_nodes(); ++node)
    for (unsigned int i = 0; i < 3; ++i)
    {
      body.velocity()[3 * node + i] = random_at(lattice(body, node, 0), i, 0);
      momentum[i] += body.mass()[3 * node + i] * body.velocity()[3 * node + i];
      mass += body.mass()[3 * node + i];
    }
  const double dt = 0.2 * stable_step(body).time_step;
  double largest_work = 0, unbalance = 0;
  for (int k = 0; k < 500; ++k)
  {
    body.compute_internal_force();
    body.kick(dt);
    const BodyEnergy e = body.energy();
    largest_work = std::max(largest_work, std::abs(e.boundary_work) / e.initial);
    unbalance = std::max(unbalance, std::abs(e.kinetic + e.elastic - e.initial) / e.initial);
    body.drift(dt);
  }
  CHECK(largest_work < 1e-13);
  CHECK(unbalance < 0.02); // of leapfrog, second order
  for (const NodeImages::Group &group : body.images().groups())
    for (const unsigned int node : group.nodes)
      for (int i = 0; i < 3; ++i)
        CHECK(body.velocity()[3 * node + i] == body.velocity()[3 * group.nodes[0] + i]);
  for (unsigned int i = 0; i < 3; ++i)
  {
    double now = 0;
    for (std::size_t node = 0; node < body.n_nodes(); ++node)
      now += body.mass()[3 * node + i] * body.velocity()[3 * node + i];
    CHECK(std::abs(now - momentum[i]) < 1e-13 * mass);
  }
}

TEST_CASE("faces that part strain a body that repeats itself evenly, and their work is what it stores")
{
  ExplicitBody body = box({true, true, true});
  const std::array<double, 3> rate{2., -1., 0.5}; // of the edges [m/s]
  body.set_face_velocity(rate);
  for (std::size_t node = 0; node < body.n_nodes(); ++node)
    for (std::size_t i = 0; i < 3; ++i)
      body.velocity()[3 * node + i] = rate[i] * body.node_position()[node][i] / edges[i];
  const double dt = 0.5 * stable_step(body).time_step;
  const int n_steps = 100;
  for (int k = 0; k < n_steps; ++k)
    step(body, dt);
  body.compute_internal_force();
  body.kick(dt);

  std::array<double, 3> strain{}, stress{};
  for (std::size_t d = 0; d < 3; ++d)
    strain[d] = n_steps * dt * rate[d] / edges[d];
  const double shear = soil.young_modulus / (2 * (1 + soil.poisson_ratio)),
               lame = 2 * shear * soil.poisson_ratio / (1 - 2 * soil.poisson_ratio);
  double energy = 0;
  for (std::size_t d = 0; d < 3; ++d)
  {
    stress[d] = lame * (strain[0] + strain[1] + strain[2]) + 2 * shear * strain[d];
    energy += 0.5 * stress[d] * strain[d] * edges[0] * edges[1] * edges[2];
  }
  for (std::size_t e = 0; e < body.n_elements(); ++e)
    for (std::size_t d = 0; d < 3; ++d)
      REQUIRE(body.state_of(e).stress[d] == Approx(stress[d]).epsilon(1e-9));
  for (std::size_t d = 0; d < 3; ++d)
    CHECK(body.face_force(d)[d] == Approx(stress[d] * edges[0] * edges[1] * edges[2] / edges[d]).epsilon(1e-9));
  CHECK(body.energy().elastic == Approx(energy).epsilon(1e-9));
  CHECK(body.energy().boundary_work == Approx(energy).epsilon(1e-9));
}

TEST_CASE("a body that repeats itself goes on with the same bits, on any number of threads and from its state")
{
  const auto run = [](const int n_threads, const bool is_restored)
  {
    const Threads threads(n_threads);
    ExplicitBody body = thrown({true, true, false}, 0, 20);
    body.set_face_velocity({0.3, 0.2, 0.});
    const double dt = 0.5 * stable_step(body).time_step;
    step(body, dt);
    if (is_restored)
    {
      ExplicitBody other = box({true, true, false}, 20.);
      const auto from = body.state(), to = other.state();
      for (std::size_t k = 0; k < from.size(); ++k)
        std::copy(from[k].second.begin(), from[k].second.end(), to[k].second.begin());
      for (int k = 0; k < 20; ++k)
        step(other, dt);
      return std::vector<double>(other.displacement().begin(), other.displacement().end());
    }
    for (int k = 0; k < 20; ++k)
      step(body, dt);
    return std::vector<double>(body.displacement().begin(), body.displacement().end());
  };
  const std::vector<double> once = run(1, false);
  CHECK(run(3, false) == once);
  CHECK(run(1, true) == once);
}

TEST_CASE("a body that repeats itself rests under loads, wherever its faces are")
{
  const auto loaded = [](const unsigned int shift)
  {
    ExplicitBody body = box({true, true, false});
    for (unsigned int i = 0; i < 3; ++i)
      body.prescribe_velocity(4, i); // its floor
    for (std::size_t node = 0; node < body.n_nodes(); ++node)
      if (body.images().first_of(node) == node) // its images bear nothing
        for (unsigned int i = 0; i < 3; ++i)
          body.external_force()[3 * node + i] = 1e3 * random_at(lattice(body, node, shift), i, 1);
    find_equilibrium(body);
    return body;
  };
  ExplicitBody body = loaded(0);
  const ExplicitBody shifted = loaded(1);
  const double reached = greatest_displacement(body);
  REQUIRE(reached > 1e-5);
  CHECK(difference(body, shifted, 1) < 1e-7 * reached);
  const double dt = 0.5 * stable_step(body).time_step;
  for (int k = 0; k < 100; ++k)
    step(body, dt);
  CHECK(body.max_velocity() * dt < 1e-8 * reached);
}

TEST_CASE("what does not repeat itself is refused, and what nothing holds is named")
{
  ExplicitBodyParameters parameters;
  parameters.material = LinearElastic(soil);
  ExplicitBody held = make_box_body({.maximum = edges, .subdivisions = n}, parameters);
  held.prescribe_velocity(4, 2);
  CHECK_THROWS_WITH(held.repeat({true, false, false}), Contains("let it repeat itself first"));

  using Places = std::vector<std::array<double, 3>>;
  CHECK_THROWS_WITH(
      NodeImages(Places{{0, 0, 0}, {1, 0, 0}, {0, 0.5, 0}, {1, 0.6, 0}, {0, 1, 1}, {1, 1, 1}}, {true, false, false}),
      Contains("(0, 0.5, 0)") && Contains("mesh opposite faces alike"));

  ExplicitBody free = box({true, true, false});
  CHECK_THROWS_WITH(find_equilibrium(free), Contains("motions along x, along y, along z") && !Contains("about"));
  free.prescribe_velocity(4, 0);
  free.prescribe_velocity(4, 1);
  free.prescribe_velocity(4, 2);
  CHECK_THROWS_WITH(find_equilibrium(free, {.duration = 1.}), Contains("duration of 0"));
  CHECK_NOTHROW(find_equilibrium(free));
}
