// Spherical balloons of rubber membranes under a pressure that follows them.
//
// A sphere of radius R and thickness t0 blown up evenly to λ R has the stretches λ, λ, λ⁻². Its Cauchy stress in the
// plane is σ = λ W_λ(λ) − (the same across) and balances the pressure on half a sphere, π r² p = 2π r t σ with r = λ R
// and t = t0 λ⁻²:
//   p = 2 t0 σ(λ)/(R λ³)
// (Needleman, Int. J. Solids Struct. 13 (1977) 409-421; Ogden, Non-Linear Elastic Deformations, 1984, sec. 5.3). For
// W = G/2 ((1 − c)(I1 − 3) + c (I2 − 3)), σ = G (λ² − λ⁻⁴)(1 − c + c λ²); for W = Σ μ/α (Σ λ_i^α − 3),
// σ = Σ μ (λ^α − λ^−2α). Both have a maximum of the pressure near λ = 1.4, from where on a given pressure does not
// hold the balloon but a given volume does.

#include "fe_dealii/boundary/surface_load.h"
#include "fe_dealii/membrane_body.h"
#include "fe_dealii/stable_step.h"
#include "tests/threads.h"

#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/tria.h>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <map>
#include <numbers>

using namespace bergamo::fe;

namespace
{

constexpr double radius = 0.05, thickness = 0.3e-3, shear_modulus = 0.5e6, density = 1000;

struct Law
{
  const char *name;
  Rubber material;
  std::function<double(double)> stress; ///< σ(λ) of the even stretch [Pa]
  std::function<double(double)> energy; ///< W(λ) [J/m³]

  double pressure(const double s) const { return 2 * thickness * stress(s) / (radius * s * s * s); }
};

Law mooney_rivlin()
{
  constexpr double poisson = 0.49, c = 0.05, g = shear_modulus;
  return {
      "Mooney-Rivlin",
      MooneyRivlin({.elastic = {.young_modulus = 2 * (1 + poisson) * g, .poisson_ratio = poisson, .density = density},
                    .second_share = c}),
      [](const double s) { return g * (s * s - std::pow(s, -4)) * (1 - c + c * s * s); },
      [](const double s) {
        return g / 2 * ((1 - c) * (2 * s * s + std::pow(s, -4) - 3) + c * (std::pow(s, 4) + 2 * std::pow(s, -2) - 3));
      }};
}

Law ogden()
{
  const OgdenParameters p;
  return {"Ogden", Ogden(p),
          [p](const double s)
          {
            double sum = 0;
            for (int n = 0; n < 3; ++n)
              sum += p.modulus[n] * (std::pow(s, p.exponent[n]) - std::pow(s, -2 * p.exponent[n]));
            return sum;
          },
          [p](const double s)
          {
            double sum = 0;
            for (int n = 0; n < 3; ++n)
              sum +=
                  p.modulus[n] / p.exponent[n] * (2 * std::pow(s, p.exponent[n]) + std::pow(s, -2 * p.exponent[n]) - 3);
            return sum;
          }};
}

void make_sphere(const unsigned int refinements, dealii::Triangulation<2, 3> &mesh)
{
  dealii::GridGenerator::hyper_sphere(mesh, dealii::Point<3>(), radius);
  mesh.refine_global(refinements);
}

/// The eighth of a sphere with x, y, z >= 0: 3·4^(refinements − 1) cells. Its planes of symmetry bar the modes in which
/// a balloon beyond its greatest pressure may bulge to one side.
void make_octant(const unsigned int refinements, dealii::Triangulation<2, 3> &mesh)
{
  dealii::Triangulation<2, 3> sphere;
  make_sphere(refinements, sphere);
  std::map<unsigned int, unsigned int> number;
  std::vector<dealii::Point<3>> vertices;
  std::vector<dealii::CellData<2>> cells;
  for (const auto &cell : sphere.active_cell_iterators())
  {
    if (cell->center()[0] < 0 || cell->center()[1] < 0 || cell->center()[2] < 0)
      continue;
    auto &data = cells.emplace_back();
    for (unsigned int vertex = 0; vertex < 4; ++vertex)
    {
      const auto [place, is_new] = number.insert({cell->vertex_index(vertex), vertices.size()});
      if (is_new)
        vertices.push_back(cell->vertex(vertex));
      data.vertices[vertex] = place->second;
    }
  }
  mesh.create_triangulation(vertices, cells, dealii::SubCellData());
}

/// An eighth of a balloon that holds a given amount of a liquid: pressure = stiffness (amount − volume).
class Balloon
{
public:
  Balloon(const Law &law, const unsigned int refinements, const double damping)
      : body(make_body(law, refinements, damping)), load(membrane_surface(body.dof_handler()), body.node_position())
  {
    for (unsigned int i = 0; i < 3; ++i)
    {
      std::vector<unsigned int> plane;
      for (unsigned int node = 0; node < body.n_nodes(); ++node)
        if (std::abs(body.node_position()[node][i]) < 1e-9 * radius)
          plane.push_back(node);
      body.prescribe_velocity(plane, i);
    }
    volume_at_rest = load.volume(displacement());
  }

  /// Blows up the places evenly.
  void scale(const double stretch)
  {
    for (std::size_t node = 0; node < body.n_nodes(); ++node)
      for (int i = 0; i < 3; ++i)
        body.displacement()[3 * node + i] = (stretch - 1) * body.node_position()[node][i];
  }

  /// Makes the liquid as stiff as a fifth of the stiffest element bears and chooses the time step, at the present
  /// places. Its only mode is ω² = stiffness Σ a²/m with the nodes' areas a.
  void choose_step()
  {
    std::vector<double> area(3 * body.n_nodes(), 0.);
    load.add_pressure(1, displacement(), area);
    double sum = 0;
    for (std::size_t dof = 0; dof < area.size(); ++dof)
      sum += area[dof] * area[dof] / body.mass()[dof];
    const double elements = stable_step(body).largest_eigenvalue;
    stiffness = 0.2 * elements / sum;
    time_step = 0.7 * 2 / std::sqrt(1.2 * elements);
  }

  void step()
  {
    pressure = stiffness * (amount - load.volume(displacement()));
    body.clear_external_force();
    load.add_pressure(-pressure, displacement(), body.external_force());
    body.compute_internal_force();
    body.kick(time_step);
    body.drift(time_step);
  }

  /// Out-of-balance force of the last step, over the largest force of the pressure on a node.
  double out_of_balance() const
  {
    double out = 0, greatest = 0;
    for (std::size_t dof = 0; dof < 3 * body.n_nodes(); ++dof)
    {
      greatest = std::max(greatest, std::abs(body.external_force()[dof]));
      if (!body.constraint_of(dof))
        out = std::max(out, std::abs(body.external_force()[dof] - body.internal_force()[dof]));
    }
    return out / greatest;
  }

  std::span<const double> displacement() const { return body.displacement(); }
  /// Of the sphere of the same growth of volume.
  double stretch() const { return std::cbrt(load.volume(displacement()) / volume_at_rest); }

  MembraneBody body;
  SurfaceLoad load;
  double stiffness = 0, amount = 0, pressure = 0, time_step = 0, volume_at_rest = 0;

private:
  static MembraneBody make_body(const Law &law, const unsigned int refinements, const double damping)
  {
    dealii::Triangulation<2, 3> mesh;
    make_octant(refinements, mesh);
    return MembraneBody(mesh, {.material = law.material, .thickness = thickness, .damping = damping});
  }
};

/// Square cells with corners on a sphere and edges of h lie up to h²/(4 R) inside. Their volume misses that, their area
/// less, so the pressure that goes with a stretch is too large by up to this share.
double flatness(const unsigned int refinements)
{
  const double edge = std::numbers::pi / 2 / (1 << refinements);
  return edge * edge / 4;
}

/// Rate at which the slowest modes, of the tension alone, come to rest first [1/s].
double critical_damping(const double stress, const double stretch)
{
  return 4 * std::sqrt(stress / density) / (radius * stretch);
}

/// A balloon at rest. @return its pressure over that of the sphere of its volume, minus one
double error_at_rest(const Law &law, const double stretch, const unsigned int refinements)
{
  Balloon balloon(law, refinements, critical_damping(law.stress(stretch), stretch));
  balloon.scale(stretch);
  balloon.choose_step();
  balloon.amount = balloon.load.volume(balloon.displacement()) + law.pressure(stretch) / balloon.stiffness;
  constexpr double balanced = 1e-7;
  int steps = 0;
  do
    balloon.step();
  while ((steps++ < 100 || balloon.out_of_balance() > balanced) && steps < 50000);
  REQUIRE(balloon.out_of_balance() <= balanced);
  return balloon.pressure / law.pressure(balloon.stretch()) - 1;
}

} // namespace

TEST_CASE("balloon: pressure over stretch, before and behind its maximum, of second order in the mesh", "[fe]")
{
  const Threads one(1);
  for (const Law &law : {mooney_rivlin(), ogden()})
  {
    double greatest = 0;
    for (const double stretch : {1.1, 1.4, 2., 3.})
    {
      greatest = std::max(greatest, law.pressure(stretch));
      double error[3];
      for (int k = 0; k < 3; ++k)
        error[k] = error_at_rest(law, stretch, 2 + k);
      CAPTURE(law.name, stretch, error[0], error[1], error[2]);
      CHECK(std::log2(error[1] / error[2]) == Approx(2).margin(0.15));
      CHECK(std::abs(error[2]) < flatness(4));
    }
    CHECK(law.pressure(3) < 0.9 * greatest); // the last ones are on the falling branch
  }
}

TEST_CASE("balloon: filled slowly from rest through the maximum of its pressure, the liquid's work is stored", "[fe]")
{
  const Threads one(1);
  for (const Law &law : {mooney_rivlin(), ogden()})
  {
    // What drags is α ρ t0 (R/r)² dr/dt, against a pressure of G t0/R: in all a share of 2 (dr/dt)/c.
    constexpr double slowness = 1e-3, last_stretch = 2.5;
    // As much again as the flat cells make for the drag, and for what rings at first.
    const double mesh_error = 2 * flatness(3);
    const double speed = slowness * std::sqrt(shear_modulus / density);
    Balloon balloon(law, 3, critical_damping(law.stress(1.4), 1.4));
    balloon.scale(last_stretch);
    balloon.choose_step();
    balloon.scale(1); // where the liquid has less area to press on
    balloon.time_step = std::min(balloon.time_step, 0.6 * stable_step(balloon.body).time_step);

    double work = 0, last_pressure = 0, last_volume = balloon.volume_at_rest, greatest_seen = 0, stretch_there = 0;
    double volume = last_volume;
    for (double time = 0; volume < balloon.volume_at_rest * std::pow(last_stretch, 3); time += balloon.time_step)
    {
      // The liquid is filled in at a speed that grows from zero, so that nothing rings.
      const double filled =
          1 + speed * time * time / (time + 10 * radius / std::sqrt(shear_modulus / density)) / radius;
      balloon.amount = balloon.volume_at_rest * std::pow(filled, 3);
      volume = balloon.load.volume(balloon.displacement());
      const double stretch = balloon.stretch();
      balloon.step();
      work += 8 * 0.5 * (last_pressure + balloon.pressure) * (volume - last_volume);
      last_pressure = balloon.pressure;
      last_volume = volume;
      if (stretch > 1.1 && std::abs(balloon.pressure / law.pressure(stretch) - 1) > mesh_error)
      {
        CAPTURE(law.name, stretch, balloon.pressure, law.pressure(stretch));
        FAIL("away from the equilibrium");
      }
      if (balloon.pressure > greatest_seen)
      {
        greatest_seen = balloon.pressure;
        stretch_there = stretch;
      }
    }
    CAPTURE(law.name, greatest_seen, stretch_there);
    CHECK(stretch_there > 1.3);
    CHECK(stretch_there < 1.6);
    CHECK(balloon.pressure < 0.85 * greatest_seen);
    const double stored = 4 * std::numbers::pi * radius * radius * thickness * law.energy(balloon.stretch());
    CHECK(work == Approx(stored).epsilon(mesh_error));
    balloon.body.compute_internal_force();
    CHECK(8 * balloon.body.elements().elastic_energy() == Approx(stored).epsilon(mesh_error));
  }
}

TEST_CASE("balloon: the energy of one that is blown up at once closes at second order in the time step", "[fe]")
{
  const Threads one(1);
  for (const Law &law : {mooney_rivlin(), ogden()})
  {
    std::vector<double> worst;
    for (const int refined : {1, 2, 4})
    {
      Balloon balloon(law, 3, 0);
      const double dt = 0.3 * stable_step(balloon.body).time_step / refined;
      const std::span<double> external = balloon.body.external_force();
      double error = 0, scale = 0;
      for (int k = 0; k < 200 * refined; ++k)
      {
        balloon.body.clear_external_force();
        balloon.load.add_pressure(-0.4 * law.pressure(1.4), balloon.displacement(), external);
        balloon.body.compute_internal_force();
        balloon.body.kick(dt);
        error = std::max(error, std::abs(balloon.body.energy().residual()));
        scale = std::max(scale, balloon.body.energy().external_work);
        balloon.body.drift(dt);
      }
      CHECK(balloon.stretch() > 1.05);
      worst.push_back(error / scale);
    }
    CAPTURE(law.name, worst[0], worst[1], worst[2]);
    CHECK(worst[2] < 1e-3);
    CHECK(std::log2(worst[1] / worst[2]) == Approx(2).margin(0.3));
  }
}

TEST_CASE("balloon: a whole one keeps its symmetry and gives the same bits on any number of threads", "[fe]")
{
  std::vector<double> first;
  for (const int count : {1, 2, 3})
  {
    const Threads threads(count);
    dealii::Triangulation<2, 3> mesh;
    make_sphere(3, mesh);
    const Law law = ogden();
    MembraneBody body(mesh, {.material = law.material, .thickness = thickness, .damping = 10});
    const SurfaceLoad load(membrane_surface(body.dof_handler()), body.node_position());
    const double dt = 0.5 * stable_step(body).time_step;
    for (int k = 0; k < 40; ++k)
    {
      body.clear_external_force();
      load.add_pressure(-0.5 * law.pressure(1.4), body.displacement(), body.external_force());
      body.compute_internal_force();
      body.kick(dt);
      body.drift(dt);
    }
    double momentum[3] = {}, scale = 0;
    for (std::size_t dof = 0; dof < 3 * body.n_nodes(); ++dof)
    {
      momentum[dof % 3] += body.mass()[dof] * body.velocity()[dof];
      scale += body.mass()[dof] * std::abs(body.velocity()[dof]);
    }
    for (const double component : momentum)
      CHECK(std::abs(component) < 1e-12 * scale);
    std::vector<double> now(body.displacement().begin(), body.displacement().end());
    now.push_back(body.energy().residual());
    if (first.empty())
      first = now;
    CHECK(std::memcmp(first.data(), now.data(), now.size() * sizeof(double)) == 0);
  }
}
