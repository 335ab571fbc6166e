// A flat sheet of rubber, stretched evenly by λ and held at its rim, swings across its plane like an ideal membrane:
// ω² = σ/ρ ((π/a)² + (π/b)²) with the Cauchy stress σ and the present edges a, b (Rayleigh, The Theory of Sound, 1877,
// § 195). All its stiffness across the plane comes from the stress.

#include "fe_dealii/membrane_body.h"
#include "fe_dealii/stable_step.h"
#include "tests/threads.h"

#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/tria.h>

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

using namespace bergamo::fe;

namespace
{

constexpr double edge[2] = {0.1, 0.07}, stretch = 1.5, share_of_step = 0.05;

/// Angular frequency of the lowest mode [1/s], counted on a sheet of n × n cells.
double frequency(const unsigned int n)
{
  dealii::Triangulation<2> flat;
  dealii::GridGenerator::subdivided_hyper_rectangle(flat, {n, n}, dealii::Point<2>(),
                                                    dealii::Point<2>(edge[0], edge[1]));
  dealii::Triangulation<2, 3> mesh;
  dealii::GridGenerator::flatten_triangulation(flat, mesh);
  const NeoHooke rubber({.young_modulus = 1.5e6, .poisson_ratio = 0.45, .density = 1100});
  MembraneBody body(mesh, {.material = rubber, .thickness = 0.4e-3});
  for (unsigned int i = 0; i < 3; ++i)
    body.prescribe_velocity(0, i);
  const auto bulge = [&](const std::size_t node)
  {
    const auto &x = body.node_position()[node];
    return std::sin(std::numbers::pi * x[0] / edge[0]) * std::sin(std::numbers::pi * x[1] / edge[1]);
  };
  std::size_t middle = 0;
  for (std::size_t node = 0; node < body.n_nodes(); ++node)
  {
    const auto &x = body.node_position()[node];
    for (int i = 0; i < 2; ++i)
      body.displacement()[3 * node + i] = (stretch - 1) * x[i];
    // So flat that the tension does not change: second order in the amplitude over the edge.
    body.displacement()[3 * node + 2] = 1e-5 * edge[1] * bulge(node);
    if (bulge(node) > bulge(middle))
      middle = node;
  }
  // Times at which the middle passes the plane, interpolated; half a period between two of them.
  const double dt = share_of_step * stable_step(body).time_step;
  double first_passage = 0, passage = 0, before = body.displacement()[3 * middle + 2];
  int n_passages = 0;
  for (double time = dt; n_passages < 5; time += dt)
  {
    body.compute_internal_force();
    body.kick(dt);
    body.drift(dt);
    const double now = body.displacement()[3 * middle + 2];
    if ((now > 0) != (before > 0))
    {
      passage = time - dt * now / (now - before);
      if (n_passages++ == 0)
        first_passage = passage;
    }
    before = now;
    REQUIRE(time < 1);
  }
  return 4 * std::numbers::pi / (passage - first_passage);
}

} // namespace

TEST_CASE("drum: a stretched sheet swings at the frequency of its tension, of second order in the mesh", "[fe]")
{
  const Threads one(1);
  const double modulus = 1.5e6 / (2 * 1.45), stress = modulus * (std::pow(stretch, 2) - std::pow(stretch, -4));
  const double exact = std::numbers::pi / stretch * std::sqrt(stress / 1100) * std::hypot(1 / edge[0], 1 / edge[1]);
  double error[3];
  for (int k = 0; k < 3; ++k)
  {
    const unsigned int n = 4u << k;
    error[k] = frequency(n) / exact - 1;
    // On a grid of n cells a sine of x = π/n meets the stiffness 4 sin²(x/2)/x² along and, of the bilinear shapes,
    // (2 + cos x)/3 across it, for a lumped mass. The time step adds at most (ω dt)²/24.
    const double x = std::numbers::pi / n;
    const double of_grid = 2 * std::sin(x / 2) / x * std::sqrt((2 + std::cos(x)) / 3) - 1;
    CAPTURE(n, error[k], of_grid);
    CHECK(std::abs(error[k] - of_grid) < std::pow(2 * share_of_step, 2) / 24);
  }
  CHECK(std::log2(std::abs(error[0] / error[1])) == Approx(2).margin(0.15));
  CHECK(std::log2(std::abs(error[1] / error[2])) == Approx(2).margin(0.15));
}
