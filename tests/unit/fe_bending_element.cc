// Hexahedra of 8 nodes that bend, element by element.

#include "dem/core/error.h"
#include "fe_dealii/element/bending_elements.h"
#include "fe_dealii/element/hexahedron.h"
#include "fe_dealii/element/hourglass_flow.h"
#include "fe_dealii/element/small_strain_bending.h"
#include "fe_dealii/explicit_body.h"
#include "fe_dealii/mesh/box_mesh.h"
#include "fe_dealii/stable_step.h"
#include "tests/deform.h"
#include "tests/unit/fe_dynamic_matrix.h"
#include "tests/unit/fe_sands.h"

#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/tria.h>
#include <deal.II/lac/lapack_full_matrix.h>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numeric>
#include <random>

using namespace bergamo;
using namespace bergamo::fe;

namespace
{

constexpr ElasticParameters rubber{.young_modulus = 1.5e6, .poisson_ratio = 0.45, .density = 1100};

ExplicitBodyParameters bending_of(const Material &material)
{
  ExplicitBodyParameters parameters;
  parameters.material = material;
  parameters.kind.hourglass = Hourglass::bending;
  return parameters;
}

ExplicitBody box(const ExplicitBodyParameters &parameters, const std::array<double, 3> &size, const unsigned int n,
                 const double distortion)
{
  dealii::Triangulation<3> mesh;
  make_box({{0, 0, 0}, size, {n, n, n}}, mesh);
  if (distortion > 0)
    dealii::GridTools::distort_random(distortion, mesh, /*keep_boundary=*/false, /*seed=*/11);
  return ExplicitBody(mesh, parameters);
}

LinearElastic elastic(const double poisson_ratio)
{
  return LinearElastic({.young_modulus = 6e7, .poisson_ratio = poisson_ratio, .density = 2000});
}

std::vector<Material> materials_of_large_strain()
{
  return {NeoHooke(rubber), MooneyRivlin({.elastic = rubber}), Ogden(OgdenParameters())};
}

std::vector<bool> surface_of(const ExplicitBody &body)
{
  std::vector<bool> is_outer(body.n_nodes(), false);
  for (unsigned int id = 0; id < 6; ++id)
    for (const unsigned int node : body.boundary_nodes(id))
      is_outer[node] = true;
  return is_outer;
}

/// Ascending, of the first element's stiffness at no displacement.
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

/// The four products of coordinates at the corners, which are the modes of a brick.
double mode_of_brick(const int mode, const int node)
{
  const int xi = node & 1 ? 1 : -1, eta = node & 2 ? 1 : -1, zeta = node & 4 ? 1 : -1;
  const int products[4] = {eta * zeta, zeta * xi, xi * eta, xi * eta * zeta};
  return products[mode];
}

} // namespace

TEST_CASE("bending elements, patch test: a linear displacement on a distorted mesh strains uniformly", "[fe]")
{
  const double gradient[3][3] = {{1e-3, -2e-4, 5e-4}, {3e-4, -7e-4, 1e-4}, {-4e-4, 6e-4, 2e-4}};
  const MohrCoulomb strong({.poisson_ratio = 0.3, .cohesion = 1e12});
  for (const Material &material : {Material(strong), Material(elastic(0.3)), Material(elastic(0.499))})
  {
    CAPTURE(material.index());
    ExplicitBody body = box(bending_of(material), {1, 1.3, 0.8}, 3, 0.25); // 27 elements: the last pack is not full
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
    for (std::size_t e = 0; e < body.n_elements(); ++e)
      for (int c = 0; c < 6; ++c)
      {
        const double expected =
            shear * (gradient[row[c]][column[c]] + gradient[column[c]][row[c]]) + (c < 3 ? lame * dilatation : 0);
        REQUIRE(body.state_of(e).stress[c] == Approx(expected).margin(1e-12 * (lame + shear)));
      }
    const std::vector<bool> is_outer = surface_of(body);
    for (std::size_t dof = 0; dof < 3 * body.n_nodes(); ++dof)
      if (!is_outer[dof / 3])
        REQUIRE(std::abs(body.internal_force()[dof]) < 1e-13 * (lame + shear));
  }
}

TEST_CASE("bending elements at large strain, patch test: a uniform deformation strains uniformly", "[fe]")
{
  const Tensor3<double> f{{{1.3, 0.2, -0.1}, {-0.15, 0.85, 0.25}, {0.1, -0.05, 1.1}}};
  for (const Material &material : materials_of_large_strain())
  {
    CAPTURE(material.index());
    ExplicitBody body = box(bending_of(material), {0.1, 0.13, 0.08}, 3, 0.2);
    deform(body, f);
    body.compute_internal_force();
    double modulus = 0, density = 0, volume = 0;
    std::visit(
        [&](const auto &law)
        {
          modulus = law.bulk_modulus();
          if constexpr (requires { law.volumetric(); })
            density = energy_density(law, f);
        },
        material);
    for (std::size_t e = 0; e < body.n_elements(); ++e)
      volume += body.elements().volume(e);
    CHECK(volume == Approx(0.1 * 0.13 * 0.08).epsilon(0.1)); // the boundary moves too
    CHECK(body.elements().elastic_energy() == Approx(density * volume).epsilon(1e-12));
    const std::vector<bool> is_outer = surface_of(body);
    for (std::size_t dof = 0; dof < 3 * body.n_nodes(); ++dof)
      if (!is_outer[dof / 3])
        REQUIRE(std::abs(body.internal_force()[dof]) < 1e-12 * modulus * 0.1 * 0.1);
  }
}

TEST_CASE("bending elements at large strain: a body turned by any angle, bent before, has the energy of before", "[fe]")
{
  const double angle = 2.1, c = std::cos(angle), s = std::sin(angle);
  for (const Material &material : materials_of_large_strain())
  {
    ExplicitBody body = box(bending_of(material), {0.1, 0.13, 0.08}, 2, 0.2);
    std::mt19937_64 random(4);
    std::normal_distribution<double> normal;
    for (double &u : body.displacement())
      u = 2e-3 * normal(random);
    body.compute_internal_force();
    const std::vector<double> force(body.internal_force().begin(), body.internal_force().end());
    const double energy = body.elements().elastic_energy();
    double scale = 0;
    for (const double f : force)
      scale = std::max(scale, std::abs(f));
    for (std::size_t node = 0; node < body.n_nodes(); ++node)
    {
      double x[3];
      for (int i = 0; i < 3; ++i)
        x[i] = body.node_position()[node][i] + body.displacement()[3 * node + i];
      const double turned[3] = {c * x[0] - s * x[1], s * x[0] + c * x[1], x[2]};
      for (int i = 0; i < 3; ++i)
        body.displacement()[3 * node + i] = turned[i] - body.node_position()[node][i];
    }
    body.compute_internal_force();
    CHECK(body.elements().elastic_energy() == Approx(energy).epsilon(1e-11));
    for (std::size_t node = 0; node < body.n_nodes(); ++node)
    {
      const double *const f = &force[3 * node];
      const double turned[3] = {c * f[0] - s * f[1], s * f[0] + c * f[1], f[2]};
      for (int i = 0; i < 3; ++i)
        REQUIRE(body.internal_force()[3 * node + i] == Approx(turned[i]).margin(1e-11 * scale));
    }
  }
}

TEST_CASE("bending elements: six motions alone have no stiffness, whatever the element", "[fe]")
{
  for (const double poisson_ratio : {0., 0.3, 0.499})
    for (const std::array<double, 3> &size :
         {std::array{1., 1., 1.}, std::array{10., 1., 1.}, std::array{0.5, 1., 1.}, std::array{1., 10., 0.3}})
      for (const double distortion : {0., 0.2})
      {
        CAPTURE(poisson_ratio, size, distortion);
        const ExplicitBody body = box(bending_of(elastic(poisson_ratio)), size, 1, distortion);
        const std::vector<double> eigenvalue = eigenvalues(body.elements());
        // The softest mode bends the longest and thinnest element: (0.3/10)² times the ratio of the moduli at least.
        CHECK(std::abs(eigenvalue[0]) < 1e-12 * eigenvalue[23]);
        CHECK(std::abs(eigenvalue[5]) < 1e-12 * eigenvalue[23]);
        CHECK(eigenvalue[6] > 1e-7 * eigenvalue[23]);
      }
}

TEST_CASE("bending elements: at a constant volume one motion alone is stiff, on any element", "[fe]")
{
  // K/G = 50 000: what changes the volume of some point is stiffer than the rest by some thousands. Only the mean of
  // the element may.
  for (const double distortion : {0., 0.2})
  {
    const ExplicitBody body = box(bending_of(elastic(0.49999)), {1, 1.2, 0.9}, 1, distortion);
    const std::vector<double> eigenvalue = eigenvalues(body.elements());
    CHECK(eigenvalue[23] > 1000 * 6e7 / 3);
    CHECK(eigenvalue[22] < 3 * 6e7 / 3);
  }
}

TEST_CASE("bending elements: forces are those of the stiffness, and the energy is half their work", "[fe]")
{
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  ExplicitBody body = box(bending_of(elastic(0.4)), {1, 1.3, 0.8}, 2, 0.2);
  for (double &x : body.displacement())
    x = 1e-4 * normal(random);
  body.compute_internal_force();
  double energy = 0;
  for (std::size_t e = 0; e < body.n_elements(); ++e)
  {
    std::vector<double> matrix(24 * 24), u(24);
    body.elements().stiffness(e, body.displacement().data(), matrix.data());
    for (int i = 0; i < 24; ++i)
      u[i] = body.displacement()[3 * body.element_nodes(e)[i / 3] + i % 3];
    for (int row = 0; row < 24; ++row)
    {
      double expected = 0;
      for (int column = 0; column < 24; ++column)
        expected += matrix[24 * row + column] * u[column];
      CHECK(body.elements().forces()[24 * e + row] == Approx(expected).margin(1e-12 * 6e7 * 1e-4));
      energy += 0.5 * expected * u[row];
    }
    CHECK(body.state_of(e).energy_density > 0);
  }
  CHECK(body.elements().elastic_energy() == Approx(energy).epsilon(1e-12));
}

TEST_CASE("bending elements: the stiffness at no strain is the same at small and at large strain", "[fe]")
{
  for (const double poisson_ratio : {0.3, 0.499})
  {
    const ElasticParameters of_both{.young_modulus = 1.5e6, .poisson_ratio = poisson_ratio, .density = 1100};
    const std::array<double, 3> size{0.3, 0.13, 0.08};
    const ExplicitBody large = box(bending_of(NeoHooke(of_both)), size, 1, 0.2),
                       small = box(bending_of(LinearElastic(of_both)), size, 1, 0.2);
    std::vector<double> a(24 * 24), b(24 * 24);
    large.elements().stiffness(0, large.displacement().data(), a.data());
    small.elements().stiffness(0, small.displacement().data(), b.data());
    const double largest = *std::max_element(b.begin(), b.end());
    for (int k = 0; k < 24 * 24; ++k)
      REQUIRE(a[k] == Approx(b[k]).margin(1e-7 * largest)); // of differences
  }
}

TEST_CASE("bending elements at large strain: compression to a third leaves every hourglass stiff", "[fe]")
{
  for (const Material &material : materials_of_large_strain())
  {
    ExplicitBody body = box(bending_of(material), {1, 1, 1}, 1, 0);
    deform(body, {{{0.33, 0, 0}, {0, 1.6, 0}, {0, 0, 1.6}}});
    std::vector<double> k(24 * 24);
    body.elements().stiffness(0, body.displacement().data(), k.data());
    std::mt19937_64 random(1);
    std::normal_distribution<double> normal;
    for (int trial = 0; trial < 200; ++trial)
    {
      double amplitude[4][3], x[24] = {}, work = 0, square = 0;
      for (auto &mode : amplitude)
        for (double &a : mode)
          a = normal(random);
      for (int node = 0; node < 8; ++node)
        for (int m = 0; m < 4; ++m)
          for (int i = 0; i < 3; ++i)
            x[3 * node + i] += mode_of_brick(m, node) * amplitude[m][i];
      for (int r = 0; r < 24; ++r)
      {
        square += x[r] * x[r];
        for (int c = 0; c < 24; ++c)
          work += x[r] * k[24 * r + c] * x[c];
      }
      REQUIRE(work > 1e-3 * 1e5 * square);
    }
  }
}

TEST_CASE("bending elements at large strain: one turned inside out at a corner is named", "[fe]")
{
  ExplicitBody body = box(bending_of(NeoHooke(rubber)), {1, 1, 1}, 3, 0);
  const std::size_t element = 17;
  // The middle of the body moved beyond the opposite corner of one of its elements; the mean volume stays positive.
  const unsigned int node = body.element_nodes(element)[0], opposite = body.element_nodes(element)[7];
  for (int i = 0; i < 3; ++i)
    body.displacement()[3 * node + i] = 0.85 * (body.node_position()[opposite][i] - body.node_position()[node][i]);
  CHECK_THROWS_WITH(body.compute_internal_force(), Catch::Contains("element 17") && Catch::Contains("inside out"));
}

TEST_CASE("bending elements: the lumped mass is that of the elements with points, shared with grains too", "[fe]")
{
  ExplicitBodyParameters parameters = bending_of(elastic(0.3));
  ExplicitBody bending = box(parameters, {1, 1.3, 0.8}, 3, 0.2);
  parameters.kind.hourglass = Hourglass::at_points;
  ExplicitBody at_points = box(parameters, {1, 1.3, 0.8}, 3, 0.2);
  const auto check = [&]
  {
    for (std::size_t dof = 0; dof < bending.mass().size(); ++dof)
      CHECK(bending.mass()[dof] == Approx(at_points.mass()[dof]).epsilon(1e-13));
  };
  check();
  std::vector<double> weight(bending.n_nodes()); // of the grains that share the space
  for (std::size_t node = 0; node < weight.size(); ++node)
    weight[node] = std::clamp(2.5 * bending.node_position()[node][0] - 0.6, 0., 0.9);
  bending.set_share(weight);
  at_points.set_share(weight);
  check();
}

TEST_CASE("bending elements with a share: a uniform stress has the forces of its integral over the share", "[fe]")
{
  constexpr double young = 6e7, poisson_ratio = 0.3;
  const double shear = young / (2 * (1 + poisson_ratio)), lame = 2 * shear * poisson_ratio / (1 - 2 * poisson_ratio);
  ExplicitBody body = box(bending_of(elastic(poisson_ratio)), {1, 1.3, 0.8}, 3, 0.15);
  std::vector<double> share(body.n_nodes()), weight(body.n_nodes());
  for (std::size_t node = 0; node < weight.size(); ++node)
  {
    weight[node] = std::clamp(2.5 * body.node_position()[node][0] - 0.6, 0., 0.999);
    share[node] = 1 - weight[node];
  }
  body.set_share(weight);
  const Tensor3<double> h{{{1e-3, 2e-4, 0}, {-3e-4, -5e-4, 1e-4}, {4e-4, 0, 2e-4}}};
  deform(body, {{{1 + h[0][0], h[0][1], h[0][2]}, {h[1][0], 1 + h[1][1], h[1][2]}, {h[2][0], h[2][1], 1 + h[2][2]}}});
  body.compute_internal_force();
  double energy = 0;
  Tensor3<double> stress;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      stress[i][j] = shear * (h[i][j] + h[j][i]) + (i == j ? lame * (h[0][0] + h[1][1] + h[2][2]) : 0);
  for (std::size_t e = 0; e < body.n_elements(); ++e)
  {
    bending::Corners corners;
    for (int node = 0; node < 8; ++node)
      corners[node] = body.node_position()[body.element_nodes(e)[node]];
    const bending::GaussPoints points(corners);
    double force[24] = {};
    for (int point = 0; point < 8; ++point)
    {
      double here = 0;
      for (int node = 0; node < 8; ++node)
        here += hexahedron::shape_value(node, point) * share[body.element_nodes(e)[node]];
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
        {
          energy += 0.5 * points.weight[point] * here * stress[i][j] * h[i][j];
          for (int node = 0; node < 8; ++node)
            force[3 * node + i] += points.weight[point] * here * stress[i][j] * points.gradient[point][node][j];
        }
    }
    for (int k = 0; k < 24; ++k)
      REQUIRE(body.elements().forces()[24 * e + k] == Approx(force[k]).margin(1e-12 * young * 1e-3));
  }
  CHECK(body.elements().elastic_energy() == Approx(energy).epsilon(1e-12));
}

TEST_CASE("bending elements without any share have no forces, and these are numbers", "[fe]")
{
  ExplicitBody body = box(bending_of(elastic(0.3)), {3, 1, 1}, 3, 0);
  std::vector<double> share(body.n_nodes());
  for (std::size_t node = 0; node < share.size(); ++node)
    share[node] = body.node_position()[node][0] < 1.5 ? 0.5 : 0.;
  body.elements().set_share(share);
  deform(body, {{{1.001, 0, 0}, {0, 1, 0}, {0, 0, 1}}});
  body.compute_internal_force();
  for (std::size_t e = 0; e < body.n_elements(); ++e)
  {
    const bool has_share = body.reference_centre(e)[0] < 2;
    double greatest = 0;
    for (int k = 0; k < 24; ++k)
    {
      REQUIRE(std::isfinite(body.elements().forces()[24 * e + k]));
      greatest = std::max(greatest, std::abs(body.elements().forces()[24 * e + k]));
    }
    CHECK((greatest > 0) == has_share);
    CHECK(body.elements().volume(e) == Approx(1. / 9));
  }
}

TEST_CASE("bending elements: hourglass forces keep what the law keeps of its trial deviator", "[fe]")
{
  // A brick under shear far beyond yield by small steps, at each of which it bends a little: the forces of the modes
  // come to rest where what they gain is what flow takes, the elastic force of the bending per shear strain times
  // the shear strain at yield.
  constexpr double cohesion = 1e4, shear = 6e7 / 2.6;
  const MohrCoulomb clay({.young_modulus = 6e7,
                          .poisson_ratio = 0.3,
                          .friction_angle = 0,
                          .dilation_angle = 0,
                          .cohesion = cohesion,
                          .density = 2000});
  const auto bend_and_shear = [](ExplicitBody &body, const double strain, const double amplitude)
  {
    for (unsigned int k = 0; k < 8; ++k)
    {
      const std::size_t node = body.element_nodes(0)[k];
      body.displacement()[3 * node] += strain * body.node_position()[node][1];
      body.displacement()[3 * node + 2] += amplitude * mode_of_brick(2, int(k));
    }
    body.compute_internal_force();
  };
  ExplicitBodyParameters parameters = bending_of(clay);
  const double pressure = cohesion * GENERATE(0, 1); // nothing to clay and to its modes
  if (pressure > 0)
    parameters.initial_stress = uniform_pressure(pressure);
  ExplicitBody flowing = box(parameters, {1, 1, 1}, 1, 0), bent = box(parameters, {1, 1, 1}, 1, 0);
  const double of_pressure = 0.25 * pressure; // on a quarter of a side
  const auto force_of = [&](const ExplicitBody &body) { return body.elements().forces()[2] - of_pressure; };
  const double at_yield = cohesion / shear, step = at_yield / 200, amplitude = 1e-3 * step;
  bend_and_shear(bent, 0, amplitude);
  const double force_of_step = force_of(bent); // the shear has none in this direction
  REQUIRE(std::abs(force_of_step) > 0);
  for (int k = 0; k < 200; ++k)
    bend_and_shear(flowing, step, amplitude);
  // Elastic up to here.
  const double rounding = 1e-15 * of_pressure * 200;
  CHECK(force_of(flowing) == Approx(200 * force_of_step).epsilon(1e-9).margin(rounding));
  for (int k = 0; k < 6000; ++k)
    bend_and_shear(flowing, step, amplitude);
  CHECK(force_of(flowing) == Approx(200 * force_of_step).epsilon(1e-3));
  for (int k = 0; k < 1000; ++k) // and without more of it they go, by e in each strain at yield
    bend_and_shear(flowing, step, 0);
  CHECK(force_of(flowing) == Approx(200 * force_of_step * std::pow(1 + 1. / 200, -1000)).epsilon(1e-3));
  // Of the shear beyond yield, 7000 steps in 1 m³; the modes' part is some thousandths of that.
  CHECK(flowing.elements().dissipated_energy() == Approx(7000 * step * cohesion).epsilon(0.01));
  // Turned back, all is elastic.
  const double before = force_of(flowing);
  bend_and_shear(flowing, -step, amplitude);
  CHECK(force_of(flowing) == Approx(before + force_of_step).epsilon(1e-9).margin(rounding));
}

TEST_CASE("the share kept of a stress lies between nothing and all of it", "[fe]")
{
  const double of[6] = {3, -1, -2, 4, 0, 1}, half[6] = {1.5, -0.5, -1, 2, 0, 0.5}, none[6] = {};
  double more[6], against[6];
  for (int i = 0; i < 6; ++i)
  {
    more[i] = 2 * of[i];
    against[i] = -of[i];
  }
  CHECK(bending::kept_share(of, of) == 1);
  CHECK(bending::kept_share(half, of) == Approx(0.5));
  CHECK(bending::kept_share(more, of) == 1);
  CHECK(bending::kept_share(against, of) == 0);
  CHECK(bending::kept_share(none, of) == 0);
  CHECK(bending::kept_share(none, none) == 0);
}

TEST_CASE("bending elements: rigid ones keep stress, hourglass forces and energies, whatever shares their pack", "[fe]")
{
  const MohrCoulomb clay({.young_modulus = 6e7,
                          .poisson_ratio = 0.3,
                          .friction_angle = 0,
                          .dilation_angle = 0,
                          .cohesion = 1e4,
                          .density = 2000});
  ExplicitBody body = box(bending_of(clay), {2, 2, 2}, 2, 0.1);
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  for (double &u : body.displacement())
    u = 1e-3 * normal(random); // beyond yield
  body.compute_internal_force();
  const ElementState before = body.state_of(5);
  const auto &elements = dynamic_cast<const SmallStrainBending<MohrCoulomb> &>(body.elements());
  const double energy = elements.hourglass_energy(5), other = elements.hourglass_energy(2);
  REQUIRE(before.plastic_strain > 0);
  REQUIRE(energy > 0);
  const auto nodes = body.element_nodes(5);
  body.make_rigid(nodes);
  for (double &u : body.displacement())
    u += 1e-3 * normal(random);
  body.compute_internal_force();
  CHECK(body.state_of(5).stress == before.stress);
  CHECK(body.state_of(5).plastic_strain == before.plastic_strain);
  CHECK(elements.hourglass_energy(5) == energy);
  CHECK(elements.hourglass_energy(2) != other);
  for (int k = 0; k < 24; ++k)
    CHECK(elements.forces()[24 * 5 + k] == 0);
}

TEST_CASE("bending elements of sand follow their law at the mean strain and name what cannot be followed", "[fe]")
{
  const HypoplasticSand sand(sands::hochstetten());
  ExplicitBodyParameters parameters = bending_of(sand);
  parameters.initial_stress = uniform_pressure(1e5);
  ExplicitBody body = box(parameters, {1, 1, 1}, 3, 0.1);
  SandState state{{-1e5, -1e5, -1e5, 0, 0, 0}, sand.parameters().initial_void_ratio};
  const Strain step{2e-5, 1e-5, -1e-4, 0, 0, 0};
  for (int k = 0; k < 100; ++k)
  {
    for (std::size_t node = 0; node < body.n_nodes(); ++node)
      for (int i = 0; i < 3; ++i)
        body.displacement()[3 * node + i] += step[i] * body.node_position()[node][i];
    body.compute_internal_force();
    state = update(sand, state, step).state;
  }
  for (std::size_t e = 0; e < body.n_elements(); ++e)
    for (int i = 0; i < 3; ++i)
      CHECK(body.state_of(e).stress[i] == Approx(state.stress[i]).epsilon(1e-6));
  CHECK(body.elements().elastic_energy() == 0);
  for (std::size_t node = 0; node < body.n_nodes(); ++node)
    body.displacement()[3 * node] -= 0.6 * body.node_position()[node][0]; // no voids left
  CHECK_THROWS_AS(body.compute_internal_force(), RunError);
}

TEST_CASE("bending elements: the bound of the stable step holds, and steps below it stay bounded", "[fe]")
{
  for (const double poisson_ratio : {0.2, 0.499})
  {
    CAPTURE(poisson_ratio);
    ExplicitBody body = box(bending_of(elastic(poisson_ratio)), {1, 1.3, 0.8}, 3, 0.25);
    const double largest = true_largest_eigenvalue(body);
    const StableStep step = stable_step(body);
    CHECK(step.largest_eigenvalue >= largest);
    CHECK(step.largest_eigenvalue < 2.5 * largest);
    const double true_step = 2 / std::sqrt(largest);
    for (const bool beyond : {false, true})
    {
      ExplicitBody moving = box(bending_of(elastic(poisson_ratio)), {1, 1.3, 0.8}, 3, 0.25);
      const double dt = beyond ? 1.1 * true_step : 0.95 * step.time_step;
      std::mt19937_64 random(3);
      for (double &v : moving.velocity())
        v = std::normal_distribution<double>()(random);
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

TEST_CASE("elements of 27 nodes with modes that bend are refused by name", "[fe]")
{
  ExplicitBodyParameters parameters = bending_of(elastic(0.3));
  parameters.degree = 2;
  CHECK_THROWS_WITH(parameters.validate(), Catch::Contains("degree = 2") && Catch::Contains("27 nodes bend anyway"));
  ExplicitBody body = box(bending_of(NeoHooke(rubber)), {1, 1, 1}, 1, 0);
  CHECK_THROWS_WITH(body.set_share(std::vector<double>(8, 0.5)), Catch::Contains("large strain"));
}
