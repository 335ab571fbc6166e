// Hexahedra of 8 nodes with enhanced strains, element by element.

#include "dem/core/error.h"
#include "fe_dealii/element/small_strain_enhanced.h"
#include "fe_dealii/explicit_body.h"
#include "fe_dealii/mesh/box_mesh.h"
#include "fe_dealii/stable_step.h"

#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/tria.h>
#include <deal.II/lac/lapack_full_matrix.h>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <complex>
#include <random>

using namespace bergamo::fe;

namespace
{

ExplicitBodyParameters enhanced_of(const Material &material)
{
  ExplicitBodyParameters parameters;
  parameters.material = material;
  parameters.strains = Strains::enhanced;
  return parameters;
}

ExplicitBody box(const Material &material, const std::array<double, 3> &size, const unsigned int n,
                 const double distortion)
{
  dealii::Triangulation<3> mesh;
  make_box({{0, 0, 0}, size, {n, n, n}}, mesh);
  if (distortion > 0)
    dealii::GridTools::distort_random(distortion, mesh, /*keep_boundary=*/false, /*seed=*/11);
  return ExplicitBody(mesh, enhanced_of(material));
}

LinearElastic elastic(const double poisson_ratio)
{
  return LinearElastic({.young_modulus = 6e7, .poisson_ratio = poisson_ratio, .density = 2000});
}

/// Ascending, of the first element's stiffness, divided by its lumped masses if `dynamic`.
std::vector<double> eigenvalues(const ElementGroup &elements)
{
  dealii::LAPACKFullMatrix<double> k(24);
  std::vector<double> raw(24 * 24), u(24, 0.);
  elements.stiffness(0, u.data(), raw.data());
  const double largest = *std::max_element(raw.begin(), raw.end());
  for (int i = 0; i < 24; ++i)
    for (int j = 0; j < 24; ++j)
    {
      REQUIRE(raw[24 * i + j] == Approx(raw[24 * j + i]).margin(1e-13 * largest));
      k(i, j) = raw[24 * i + j];
    }
  k.compute_eigenvalues();
  std::vector<double> result;
  for (int i = 0; i < 24; ++i)
    result.push_back(k.eigenvalue(i).real());
  std::sort(result.begin(), result.end());
  return result;
}

/// Largest force on the modes of any element over what its stresses do on one mode alone.
template <class Law>
double out_of_balance(const SmallStrainEnhanced<Law> &elements)
{
  double worst = 0;
  for (std::size_t e = 0; e < elements.size(); ++e)
  {
    const enhanced::Geometry &geometry = elements.geometry(e);
    const std::array<double, 9> force = elements.inner_force(e);
    for (int mode = 0; mode < 3; ++mode)
    {
      double scale = 0;
      for (int point = 0; point < 8; ++point)
        for (int i = 0; i < 3; ++i)
          for (int c = 0; c < 6; ++c)
            scale += geometry.volume[point] * std::abs(geometry.gradient[i][8 + mode][point]) *
                     std::abs(elements.stress(e, point)[c]);
      for (int i = 0; i < 3; ++i)
        worst = std::max(worst, std::abs(force[3 * mode + i]) / scale);
    }
  }
  return worst;
}

} // namespace

TEST_CASE("enhanced strains, patch test: a linear displacement on a distorted mesh strains uniformly", "[fe]")
{
  const double gradient[3][3] = {{1e-3, -2e-4, 5e-4}, {3e-4, -7e-4, 1e-4}, {-4e-4, 6e-4, 2e-4}};
  const MohrCoulomb strong({.poisson_ratio = 0.3, .cohesion = 1e12});
  for (const Material &material : {Material(strong), Material(elastic(0.3)), Material(elastic(0.499))})
  {
    CAPTURE(material.index());
    ExplicitBody body = box(material, {1, 1.3, 0.8}, 3, 0.25);
    for (std::size_t node = 0; node < body.n_nodes(); ++node)
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          body.displacement()[3 * node + i] += gradient[i][j] * body.node_position()[node][j];
    body.compute_internal_force();
    double lame = 0, shear = 0;
    std::visit(
        [&](const auto &law)
        {
          shear = law.shear_modulus();
          lame = law.bulk_modulus() - 2 * shear / 3;
        },
        material);
    const double dilatation = gradient[0][0] + gradient[1][1] + gradient[2][2];
    constexpr int row[6] = {0, 1, 2, 0, 1, 2}, column[6] = {0, 1, 2, 1, 2, 0};
    const auto check = [&](const auto &elements)
    {
      for (std::size_t e = 0; e < body.n_elements(); ++e)
      {
        for (int point = 0; point < 8; ++point)
          for (int c = 0; c < 6; ++c)
          {
            const double expected =
                shear * (gradient[row[c]][column[c]] + gradient[column[c]][row[c]]) + (c < 3 ? lame * dilatation : 0);
            REQUIRE(elements.stress(e, point)[c] == Approx(expected).margin(1e-12 * (lame + shear)));
          }
        for (const double a : elements.inner_displacement(e))
          REQUIRE(std::abs(a) < 1e-12 * 1e-3);
      }
    };
    if (material.index() == 0)
      check(dynamic_cast<const SmallStrainEnhanced<LinearElastic> &>(body.elements()));
    else
      check(dynamic_cast<const SmallStrainEnhanced<MohrCoulomb> &>(body.elements()));
    std::vector<bool> outer(body.n_nodes(), false);
    for (unsigned int id = 0; id < 6; ++id)
      for (const unsigned int node : body.boundary_nodes(id))
        outer[node] = true;
    for (std::size_t dof = 0; dof < 3 * body.n_nodes(); ++dof)
      if (!outer[dof / 3])
        REQUIRE(std::abs(body.internal_force()[dof]) < 1e-13 * (lame + shear));
  }
}

TEST_CASE("enhanced strains: a rigid motion strains nothing, and six modes alone have no stiffness", "[fe]")
{
  for (const double poisson_ratio : {0., 0.3, 0.499})
    for (const std::array<double, 3> &size :
         {std::array{1., 1., 1.}, std::array{10., 1., 1.}, std::array{0.5, 1., 1.}, std::array{1., 10., 0.3}})
      for (const double distortion : {0., 0.2})
      {
        CAPTURE(poisson_ratio, size, distortion);
        const ExplicitBody body = box(elastic(poisson_ratio), size, 1, distortion);
        const std::vector<double> eigenvalue = eigenvalues(body.elements());
        // The softest mode bends the longest and thinnest element: (0.3/10)² times the ratio of the moduli at least.
        CHECK(std::abs(eigenvalue[0]) < 1e-12 * eigenvalue[23]);
        CHECK(std::abs(eigenvalue[5]) < 1e-12 * eigenvalue[23]);
        CHECK(eigenvalue[6] > 1e-7 * eigenvalue[23]);
      }
}

TEST_CASE("enhanced strains: at a constant volume one mode alone is stiff, on any element", "[fe]")
{
  // K/G = 50 000: what changes the volume of some point is stiffer than the rest by some thousands. Only the mean of
  // the element may.
  for (const double distortion : {0., 0.2})
  {
    const ExplicitBody body = box(elastic(0.49999), {1, 1.2, 0.9}, 1, distortion);
    const std::vector<double> eigenvalue = eigenvalues(body.elements());
    CHECK(eigenvalue[23] > 1000 * 6e7 / 3);
    CHECK(eigenvalue[22] < 3 * 6e7 / 3);
  }
}

TEST_CASE("enhanced strains: forces are work-conjugate to the strains and those of the stiffness", "[fe]")
{
  ExplicitBody body = box(elastic(0.4), {1, 1.3, 0.8}, 1, 0.2);
  const auto &elements = dynamic_cast<const SmallStrainEnhanced<LinearElastic> &>(body.elements());
  const enhanced::Geometry &geometry = elements.geometry(0);
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  Points stress[6], strain[6];
  for (auto &component : stress)
    for (int point = 0; point < 8; ++point)
      component[point] = normal(random);
  double u[33], force[33], work = 0, virtual_work = 0;
  for (double &x : u)
    x = normal(random);
  enhanced::strain(geometry, u, strain);
  enhanced::internal_force(geometry, stress, force);
  for (int i = 0; i < 33; ++i)
    work += force[i] * u[i];
  for (int i = 0; i < 6; ++i)
    virtual_work += sum(geometry.volume * stress[i] * strain[i]);
  CHECK(work == Approx(virtual_work).epsilon(1e-12));

  std::vector<double> matrix(24 * 24);
  elements.stiffness(0, u, matrix.data());
  for (double &x : body.displacement())
    x = 1e-4 * normal(random);
  body.compute_internal_force();
  std::vector<double> of_element(24);
  for (int i = 0; i < 24; ++i)
    of_element[i] = body.displacement()[3 * body.element_nodes(0)[i / 3] + i % 3];
  for (int row = 0; row < 24; ++row)
  {
    double expected = 0;
    for (int column = 0; column < 24; ++column)
      expected += matrix[24 * row + column] * of_element[column];
    CHECK(elements.forces()[row] == Approx(expected).margin(1e-12 * 6e7 * 1e-4));
  }
  CHECK(out_of_balance(elements) < 1e-12);
  double energy = 0;
  for (int row = 0; row < 24; ++row)
    energy += 0.5 * elements.forces()[row] * of_element[row];
  CHECK(elements.elastic_energy() == Approx(energy).epsilon(1e-12));
}

TEST_CASE("enhanced strains: stresses are in balance on the modes after steps of any size, plastic flow included",
          "[fe]")
{
  const double size = GENERATE(1e-6, 1e-5, 1e-4, 1e-3);
  const bool associated = GENERATE(true, false);
  const double reference_pressure = GENERATE(0., 5e4);
  CAPTURE(size, associated, reference_pressure);
  const MohrCoulomb sand({.young_modulus = 60e6,
                          .poisson_ratio = 0.2,
                          .friction_angle = 30,
                          .dilation_angle = associated ? 30. : 8.,
                          .cohesion = 2e3,
                          .reference_pressure = reference_pressure});
  dealii::Triangulation<3> mesh;
  make_box({{0, 0, 0}, {1, 1, 1}, {4, 4, 4}}, mesh);
  dealii::GridTools::distort_random(0.2, mesh, true, 3);
  ExplicitBodyParameters parameters = enhanced_of(sand);
  parameters.initial_stress = uniform_pressure(2e4);
  ExplicitBody body(mesh, parameters);
  auto &elements = dynamic_cast<SmallStrainEnhanced<MohrCoulomb> &>(body.elements());
  std::mt19937_64 random(8);
  std::normal_distribution<double> normal;
  int flowing = 0;
  double worst = 0;
  std::vector<double> velocity(3 * body.n_nodes());
  for (double &v : velocity)
    v = normal(random);
  for (int step = 0; step < 50; ++step)
  {
    for (double &v : velocity) // a path that bends
      v = 0.9 * v + 0.3 * normal(random);
    for (std::size_t dof = 0; dof < velocity.size(); ++dof)
      body.displacement()[dof] += size * velocity[dof] / 4;
    body.compute_internal_force();
    worst = std::max(worst, out_of_balance(elements));
    for (std::size_t e = 0; e < elements.size(); ++e)
      for (int point = 0; point < 8; ++point)
        flowing += elements.sector(e, point) != Sector::elastic;
  }
  CAPTURE(flowing, worst, elements.n_unbalanced());
  // Steps of an explicit run are of 1e-5 and less. Of strains far beyond the elastic ones, in every direction at once,
  // some steps find no balance, which is counted.
  if (size <= 1e-5)
    CHECK(elements.n_unbalanced() == 0);
  CHECK((worst < 1e-11 || elements.n_unbalanced() > 0));
  if (size > 1e-5)
    CHECK(flowing > 50 * 64);
}

TEST_CASE("enhanced strains: the bound of the stable step holds, and steps below it stay bounded", "[fe]")
{
  for (const double poisson_ratio : {0.2, 0.499})
  {
    CAPTURE(poisson_ratio);
    ExplicitBody body = box(elastic(poisson_ratio), {1, 1.3, 0.8}, 3, 0.25);
    const unsigned int n = 3 * body.n_nodes();
    dealii::LAPACKFullMatrix<double> matrix(n);
    for (std::size_t e = 0; e < body.n_elements(); ++e)
    {
      double k[24][24];
      body.elements().stiffness(e, body.displacement().data(), &k[0][0]);
      const auto nodes = body.element_nodes(e);
      for (unsigned int i = 0; i < 24; ++i)
        for (unsigned int j = 0; j < 24; ++j)
        {
          const unsigned int r = 3 * nodes[i / 3] + i % 3, c = 3 * nodes[j / 3] + j % 3;
          matrix(r, c) += k[i][j] / std::sqrt(body.mass()[r] * body.mass()[c]);
        }
    }
    matrix.compute_eigenvalues();
    double largest = 0;
    for (unsigned int i = 0; i < n; ++i)
      largest = std::max(largest, matrix.eigenvalue(i).real());
    const StableStep step = stable_step(body);
    CHECK(step.largest_eigenvalue >= largest);
    CHECK(step.largest_eigenvalue < 2.5 * largest);
    const double true_step = 2 / std::sqrt(largest);
    for (const bool beyond : {false, true})
    {
      ExplicitBody moving = box(elastic(poisson_ratio), {1, 1.3, 0.8}, 3, 0.25);
      const double dt = beyond ? 1.1 * true_step : 0.95 * step.time_step;
      std::mt19937_64 random(3);
      for (std::size_t dof = 0; dof < n; ++dof)
        moving.velocity()[dof] = std::normal_distribution<double>()(random);
      const double start = moving.max_velocity();
      double greatest = 0;
      for (int k = 0; k < 600 && greatest < 1e6 * start; ++k)
      {
        moving.compute_internal_force();
        moving.kick(dt);
        moving.drift(dt);
        greatest = std::max(greatest, moving.max_velocity());
      }
      if (beyond)
        CHECK(greatest > 1e5 * start);
      else
        CHECK(greatest < 10 * start);
    }
  }
}

TEST_CASE("enhanced strains where there are none are refused by name", "[fe]")
{
  ExplicitBodyParameters parameters = enhanced_of(elastic(0.3));
  parameters.degree = 2;
  CHECK_THROWS_WITH(parameters.validate(), Catch::Contains("degree = 2") && Catch::Contains("enhanced strains"));
  ExplicitBody body = box(elastic(0.3), {1, 1, 1}, 1, 0);
  CHECK_THROWS_WITH(body.set_share(std::vector<double>(8, 0.5)), Catch::Contains("enhanced strains"));
}
