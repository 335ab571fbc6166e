#include "benchmarks/solid_case.h"

#include "fe_dealii/element/small_strain_elements.h"
#include "fe_dealii/mesh/box_mesh.h"

#include <deal.II/grid/tria.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <random>

namespace bergamo::benchmark
{
namespace
{

using Clock = std::chrono::steady_clock;

double seconds_between(const Clock::time_point start, const Clock::time_point end)
{
  return std::chrono::duration<double>(end - start).count();
}

/// Strain of greatest principal value −1, without dilatation, in no particular direction.
Eigen::Matrix3d unit_strain()
{
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.6, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  return turn * Eigen::Vector3d(-1., 0.2, 0.8).asDiagonal() * turn.transpose();
}

fe::ExplicitBody make_body(const SolidCase &what, const int n_along)
{
  const auto n = static_cast<unsigned int>(n_along);
  dealii::Triangulation<3> mesh;
  fe::make_box({.subdivisions = {n, n, n}}, mesh);
  return fe::ExplicitBody(mesh, {.material = what.material,
                                 .degree = what.degree,
                                 .kind = {.hourglass = what.hourglass},
                                 .initial_stress = what.initial_stress()});
}

} // namespace

std::vector<SolidCase> solid_cases()
{
  constexpr fe::ElasticParameters soil{.young_modulus = 60e6, .poisson_ratio = 0.145, .density = 1600},
      rubber{.young_modulus = 1.5e6, .poisson_ratio = 0.45, .density = 1100};
  const fe::MohrCoulomb sand{fe::MohrCoulombParameters()};
  fe::MohrCoulombParameters by_pressure;
  by_pressure.reference_pressure = 100e3;
  constexpr double pressure = 20e3; // small, so that few steps lead to the yield surface
  std::vector<SolidCase> cases;
  for (const auto &[degree, hourglass] :
       {std::pair(1u, fe::Hourglass::at_points), {1u, fe::Hourglass::bending}, {2u, fe::Hourglass::at_points}})
  {
    const std::size_t first = cases.size();
    cases.push_back({"elastic", degree, fe::LinearElastic(soil), pressure, 0., 1e-8});
    cases.push_back({"Mohr-Coulomb elastic", degree, sand, pressure, 0., 1e-8});
    cases.push_back({"Mohr-Coulomb flowing", degree, sand, pressure, 0., 1e-5, 50});
    cases.push_back({"M.-C. flowing, E(p)", degree, fe::MohrCoulomb(by_pressure), pressure, 0., 1e-5, 100});
    cases.push_back({"Neo-Hooke", degree, fe::NeoHooke(rubber), 0., 0.15, 1e-6});
    cases.push_back({"Mooney-Rivlin", degree, fe::MooneyRivlin({.elastic = rubber}), 0., 0.15, 1e-6});
    cases.push_back({"Ogden", degree, fe::Ogden(fe::OgdenParameters()), 0., 0.15, 1e-6});
    for (std::size_t k = first; hourglass == fe::Hourglass::bending && k < cases.size(); ++k)
    {
      cases[k].hourglass = hourglass;
      cases[k].name += ", bends";
    }
  }
  return cases;
}

int edges_of_cube(const SolidCase &what, const int n_elements)
{
  return std::max(1, static_cast<int>(std::lround(std::cbrt(n_elements) / what.degree)));
}

MovingSolid::MovingSolid(const SolidCase &what, const int n_along)
    : body(make_body(what, n_along)), n_points(what.n_points()),
      time_step(0.2 / (n_along * what.degree * fe::p_wave_speed(what.material)))
{
  const double between_nodes = 1. / (n_along * what.degree);
  const Eigen::Matrix3d rate = what.strain_per_step / time_step * unit_strain(),
                        start = -what.initial_strain * unit_strain();
  constexpr double jitter = 0.2; // of the strain, from node to node
  std::mt19937_64 generator(1);
  std::uniform_real_distribution<double> draw(-jitter * between_nodes, jitter * between_nodes);
  std::vector<bool> on_boundary(body.n_nodes(), false);
  for (unsigned int face = 0; face < 6; ++face)
    for (const unsigned int node : body.boundary_nodes(face))
      on_boundary[node] = true;
  for (unsigned int node = 0; node < body.n_nodes(); ++node)
  {
    const Eigen::Vector3d x = Eigen::Map<const Eigen::Vector3d>(body.node_position()[node].data()),
                          off(draw(generator), draw(generator), draw(generator));
    const Eigen::Vector3d at = on_boundary[node] ? x : x + off;
    const Eigen::Vector3d velocity = rate * at, displacement = start * at;
    for (unsigned int i = 0; i < 3; ++i)
    {
      body.velocity()[3 * node + i] = velocity[i];
      body.displacement()[3 * node + i] = displacement[i];
      if (on_boundary[node])
        body.prescribe_velocity({&node, 1}, i, velocity[i]);
    }
  }
  step(what.n_first_steps);
}

MovingSolid::Times MovingSolid::step(const int n_steps)
{
  Times times;
  for (int n = 0; n < n_steps; ++n)
  {
    const auto start = Clock::now();
    body.compute_internal_force();
    const auto forces = Clock::now();
    body.kick(time_step);
    const auto kicked = Clock::now();
    body.drift(time_step);
    times.force += seconds_between(start, forces);
    times.kick += seconds_between(forces, kicked);
    times.drift += seconds_between(kicked, Clock::now());
  }
  return times;
}

double MovingSolid::flowing_share() const
{
  const auto *const elements = dynamic_cast<const fe::SmallStrainElements<fe::MohrCoulomb> *>(&body.elements());
  if (!elements)
    return 0.;
  std::size_t n_flowing = 0;
  for (std::size_t e = 0; e < elements->size(); ++e)
    for (int point = 0; point < n_points; ++point)
      n_flowing += elements->sector(e, point) != fe::Sector::elastic;
  return static_cast<double>(n_flowing) / (n_points * elements->size());
}

} // namespace bergamo::benchmark
