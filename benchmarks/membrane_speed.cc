#include "benchmarks/membrane_speed.h"

#include "fe_dealii/membrane_body.h"

#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/tria.h>

#include <chrono>
#include <cmath>
#include <random>
#include <stdexcept>

namespace bergamo::benchmark
{
namespace
{

using Clock = std::chrono::steady_clock;

constexpr double edge = 1., young_modulus = 1.5e6, density = 1000.; // [m], [Pa], [kg/m³]

/// A sheet held along its edges, stretched alike in both directions, whose nodes move a little each by itself.
fe::MembraneBody moving_sheet(const int n_along)
{
  dealii::Triangulation<2, 3> mesh;
  const auto n = static_cast<unsigned int>(n_along);
  dealii::GridGenerator::subdivided_hyper_rectangle(mesh, std::vector<unsigned int>{n, n}, dealii::Point<2>(),
                                                    dealii::Point<2>(edge, edge));
  const fe::NeoHooke rubber({.young_modulus = young_modulus, .poisson_ratio = 0.49, .density = density});
  fe::MembraneBody sheet(mesh, {.material = rubber, .thickness = 1e-3});
  constexpr double stretch = 1.15;
  std::mt19937_64 generator(1);
  std::uniform_real_distribution<double> draw(-0.01, 0.01); // [m/s]
  for (unsigned int node = 0; node < sheet.n_nodes(); ++node)
    for (unsigned int i = 0; i < 3; ++i)
    {
      const auto &x = sheet.node_position()[node];
      sheet.displacement()[3 * node + i] = (stretch - 1.) * x[i];
      if (x[0] == 0. || x[0] == edge || x[1] == 0. || x[1] == edge)
        sheet.prescribe_velocity({&node, 1}, i, 0.);
      else
        sheet.velocity()[3 * node + i] = draw(generator);
    }
  return sheet;
}

/// A point 80 for the stretches (48 for the images of the directions, 15 for C, 17 for its values and their angle), 15
/// for the stresses, 66 for the forces, 11 for energy and growth; 12 sums at the nodes, 105 at a node as in
/// solid_cost.h.
double operations_of_element(const double nodes_per_element)
{
  return fe::membrane::n_points * (80. + 15. + 66. + 11.) + 12. + 105. * nodes_per_element;
}

/// As memory_of() at large strain.
double bytes_of_element(const double nodes_per_element)
{
  constexpr double real = sizeof(double), forces = 3 * fe::membrane::n_nodes * real, n_vectors = 16.;
  return sizeof(fe::membrane::Geometry) + 3. * forces + 2. * real + 2. * fe::membrane::n_nodes * sizeof(unsigned int) +
         nodes_per_element * (3. * (n_vectors * real + sizeof(int)) + sizeof(std::size_t));
}

} // namespace

MembraneSpeed measure_membranes(const int n_along, const int n_repeats, const int n_steps)
{
  fe::MembraneBody sheet = moving_sheet(n_along);
  const double n_elements = sheet.n_elements(), nodes_per_element = sheet.n_nodes() / n_elements;
  const double time_step = 0.2 * edge / n_along / std::sqrt(2. * young_modulus / density);
  const auto step = [&](const int n)
  {
    for (int k = 0; k < n; ++k)
    {
      sheet.compute_internal_force();
      sheet.kick(time_step);
      sheet.drift(time_step);
    }
  };
  step(5); // brings the data to the core
  std::vector<double> cost;
  for (int repeat = 0; repeat < n_repeats; ++repeat)
  {
    const auto start = Clock::now();
    step(n_steps);
    cost.push_back(1e9 * std::chrono::duration<double>(Clock::now() - start).count() / (n_steps * n_elements));
  }
  if (!sheet.is_finite())
    throw std::runtime_error("membranes: the motion has diverged, its times mean nothing");
  return {n_elements, spread(cost), operations_of_element(nodes_per_element), bytes_of_element(nodes_per_element)};
}

} // namespace bergamo::benchmark
