// Beams of one element of 8 nodes over the thickness, whatever the element's length, at small and at large strain: the
// hourglass stiffness of enhanced strains holds the field of pure bending on bricks, so what beam theory says is met
// but for the moment that an element takes for even.

#include "fe_dealii/explicit_body.h"
#include "fe_dealii/mesh/box_mesh.h"
#include "fe_dealii/mesh/material_box.h"
#include "fe_dealii/stable_step.h"
#include "tests/verification/fe_static.h"

#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/tria.h>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

using namespace bergamo::fe;

namespace
{

constexpr double length = 40, young = 1e7, heavy = 1000; // thickness and width 1
constexpr double inertia = 1. / 12;

/// Of the forces, what is lost to rounding: of displacements of the length at small strain, ε E L/((1 − 2ν) h P), 5e-10
/// at ν = 0.499; at large strain of a deformation gradient of 1 at strains of 1e-4, so 1e4 times that.
double rounding(const Material &material)
{
  return std::holds_alternative<LinearElastic>(material) ? 1e-8 : 2e-5;
}

/// Along x, bent in z; at its root held in x, in the middle of it across, so that it may narrow as it likes.
ExplicitBody beam(const Material &material, const unsigned int n_elements)
{
  ExplicitBodyParameters parameters;
  parameters.material = material;
  parameters.kind.hourglass = Hourglass::bending;
  return make_box_body({{0, -0.5, -0.5}, {length, 0.5, 0.5}, {n_elements, 1, 1}}, parameters);
}

ElasticParameters rubber(const double poisson_ratio)
{
  return {.young_modulus = young, .poisson_ratio = poisson_ratio, .density = heavy};
}

/// Of small and of large strain.
std::array<Material, 2> both(const double poisson_ratio)
{
  return {LinearElastic(rubber(poisson_ratio)), NeoHooke(rubber(poisson_ratio))};
}

/// Strains of 1e-4: what large strain adds to the displacements is less than (κ L)²/12 = 5e-6 of them.
constexpr double small_force = 4, small_moment = small_force * length;

std::vector<unsigned int> end_nodes(const ExplicitBody &body)
{
  return body.boundary_nodes(1);
}

/// No turn about x: both nodes of the lower edge at the root rest on the same height, as do those at its sides.
std::map<unsigned int, double> held_root(const ExplicitBody &body, const double poisson_ratio, const double curvature)
{
  std::map<unsigned int, double> held;
  for (const unsigned int node : body.boundary_nodes(0))
  {
    const auto &[x, y, z] = body.node_position()[node];
    held[3 * node] = 0;
    // Where the field of pure bending about the beam's axis has them.
    held[3 * node + 1] = poisson_ratio * curvature * y * z;
    held[3 * node + 2] = 0.5 * curvature * poisson_ratio * (z * z - y * y);
  }
  return held;
}

/// Mean of a displacement component over the end.
double end_displacement(const ExplicitBody &body, const int component)
{
  double sum = 0;
  for (const unsigned int node : end_nodes(body))
    sum += body.displacement()[3 * node + component] / 4;
  return sum;
}

} // namespace

TEST_CASE("bending elements: pure bending is exact, one element over the thickness, of any length, at any volume",
          "[fe]")
{
  for (const double poisson_ratio : {0., 0.3, 0.499})
    for (const Material &material : both(poisson_ratio))
      for (const double ratio : {10., 5., 2.5, 1., 0.5})
      {
        CAPTURE(poisson_ratio, material.index(), ratio);
        ExplicitBody body = beam(material, std::lround(length / ratio));
        constexpr double curvature = small_moment / (young * inertia);
        std::vector<double> load(3 * body.n_nodes(), 0.);
        for (const unsigned int node : end_nodes(body)) // two couples of arm 1
          load[3 * node] = body.node_position()[node][2] > 0 ? -small_moment / 2 : small_moment / 2;
        bring_to_rest(body, load, held_root(body, poisson_ratio, curvature), rounding(material));
        // The corners' deflection: that of the axis, and what the section's own shape adds, which is nothing at y² =
        // z².
        CHECK(end_displacement(body, 2) == Approx(0.5 * curvature * length * length).epsilon(1e-4));
      }
}

TEST_CASE("bending elements: a cantilever's deflection is beam theory's less 1/4 n^2", "[fe]")
{
  // An element takes the moment at its middle for that of all of it: of P L³/3EI it misses the share 1/(4 n²). The
  // shear adds P L/(G A) with an even shear strain, where beam theory has 6/5 of it.
  for (const double poisson_ratio : {0.3, 0.499})
    for (const Material &material : both(poisson_ratio))
      for (const double ratio : {10., 5., 2.5, 1., 0.5})
      {
        CAPTURE(poisson_ratio, material.index(), ratio);
        const unsigned int n = std::lround(length / ratio);
        ExplicitBody body = beam(material, n);
        std::vector<double> load(3 * body.n_nodes(), 0.);
        for (const unsigned int node : end_nodes(body))
          load[3 * node + 2] = small_force / 4;
        bring_to_rest(body, load, held_root(body, poisson_ratio, small_moment / (young * inertia)), rounding(material));
        const double shear = young / (2 * (1 + poisson_ratio));
        const double bent = small_force * std::pow(length, 3) / (3 * young * inertia),
                     sheared = small_force * length / shear;
        const double deflection = end_displacement(body, 2);
        CAPTURE(deflection / (bent + 1.2 * sheared));
        CHECK(deflection == Approx(bent * (1 - 0.25 / (n * n)) + sheared).epsilon(2e-3)); // the root is no free section
        CHECK(deflection == Approx(bent + 1.2 * sheared).epsilon(0.05));
      }
}

TEST_CASE("bending elements: a cantilever in plane strain, its root held in all directions", "[fe]")
{
  // The same as above with E/(1 − ν²); what the root holds of the thickness is within an element.
  for (const double poisson_ratio : {0.3, 0.499})
    for (const Material &material : both(poisson_ratio))
      for (const double ratio : {10., 5., 2.5, 1., 0.5})
      {
        CAPTURE(poisson_ratio, material.index(), ratio);
        ExplicitBody body = beam(material, std::lround(length / ratio));
        for (unsigned int i = 0; i < 3; ++i)
          body.prescribe_velocity(0u, i);
        for (const unsigned int side : {2u, 3u})
          body.prescribe_velocity(side, 1);
        std::vector<double> load(3 * body.n_nodes(), 0.);
        for (const unsigned int node : end_nodes(body))
          load[3 * node + 2] = small_force / 4;
        bring_to_rest(body, load, {}, rounding(material));
        const double shear = young / (2 * (1 + poisson_ratio)), plane = young / (1 - poisson_ratio * poisson_ratio);
        CHECK(end_displacement(body, 2) ==
              Approx(small_force * (std::pow(length, 3) / (3 * plane * inertia) + 1.2 * length / shear)).epsilon(0.05));
      }
}

TEST_CASE("bending elements: a cantilever swings at the frequency of beam theory, its energy kept", "[fe]")
{
  // Ten elements of twice their thickness, length 20: Euler and Bernoulli's 1.8751² sqrt(EI/ρA L⁴), less what shear and
  // rotation of the sections take (about 3 (h/L)² = 0.7 %), within 2 %.
  ExplicitBodyParameters parameters;
  parameters.material = both(0.3)[GENERATE(0, 1)];
  parameters.kind.hourglass = Hourglass::bending;
  constexpr double span = 20;
  ExplicitBody body = make_box_body({{0, -0.5, -0.5}, {span, 0.5, 0.5}, {10, 1, 1}}, parameters);
  for (int i = 0; i < 3; ++i)
    body.prescribe_velocity(0u, i);
  for (std::size_t node = 0; node < body.n_nodes(); ++node)
  {
    const double x = body.node_position()[node][0] / span, b = 1.8751, s = 0.7341;
    body.velocity()[3 * node + 2] = std::cosh(b * x) - std::cos(b * x) - s * (std::sinh(b * x) - std::sin(b * x));
  }
  const double frequency = 1.8751 * 1.8751 * std::sqrt(young * inertia / heavy) / (span * span); // rad/s
  const double dt = 0.5 * stable_step(body).time_step, period = 2 * std::numbers::pi / frequency;
  std::vector<double> crossings;
  double before = 0, worst = 0, scale = 0;
  for (int k = 0; body.time() < 2.2 * period; ++k)
  {
    body.compute_internal_force();
    body.kick(dt);
    if (k > 0)
    {
      worst = std::max(worst, std::abs(body.energy().residual()));
      scale = std::max(scale, body.energy().elastic);
    }
    const double time = body.time();
    body.drift(dt);
    const double now = end_displacement(body, 2);
    if (k > 0 && before * now < 0)
      crossings.push_back(time + dt * before / (before - now));
    before = now;
  }
  REQUIRE(crossings.size() >= 4);
  CHECK(crossings[3] / 2 == Approx(period).epsilon(0.02));
  // The work of forces that are linear in the displacement is exact, of others to the second order of the step.
  CHECK(worst < (body.elements().stiffens_with_displacement() ? 1e-5 : 1e-11) * scale);
}

TEST_CASE("bending elements at large strain: a cantilever bends to the elastica, one element over the thickness",
          "[fe]")
{
  // Mattiasson, Int. J. Numer. Meth. Eng. 17 (1981) 145-153: deflection and shortening over L at P L²/EI = 1, 2, 5.
  for (const double poisson_ratio : {0.3, 0.499})
    for (const double ratio : {5., 2.5, 1.})
    {
      CAPTURE(poisson_ratio, ratio);
      ExplicitBody body = beam(NeoHooke(rubber(poisson_ratio)), std::lround(length / ratio));
      for (const unsigned int node : body.boundary_nodes(0))
        for (unsigned int i = 0; i < 3; ++i)
        {
          const unsigned int one[] = {node};
          const auto &[x, y, z] = body.node_position()[node];
          if (i == 0 || (i == 1 && y < 0) || (i == 2 && z < 0))
            body.prescribe_velocity(one, i);
        }
      const std::array<std::array<double, 3>, 3> exact{
          {{1, 0.30172, 0.05643}, {2, 0.49346, 0.16064}, {5, 0.71379, 0.38763}}};
      for (const auto &[load, deflection, shortening] : exact)
      {
        body.clear_external_force();
        for (const unsigned int node : end_nodes(body))
          body.external_force()[3 * node + 2] = load * young * inertia / (length * length) / 4;
        find_equilibrium(body, {.tolerance = 1e-8});
        const double w = end_displacement(body, 2) / length, u = -end_displacement(body, 0) / length;
        CAPTURE(load, w, u);
        CHECK(w == Approx(deflection).epsilon(0.02));
        CHECK(u == Approx(shortening).epsilon(0.04));
      }
    }
}

namespace
{

/// A beam of unit width whose layers differ in their modulus alone, one element over each, with what beam theory says
/// of it: plane sections about the axis where moduli and stresses have no resultant (Timoshenko, J. Opt. Soc. Am. 11
/// (1925) 233-255).
struct LayeredBeam
{
  std::vector<double> top, moduli; // of the layers, from z = 0 upwards
  double poisson_ratio;

  double bottom(const std::size_t layer) const { return layer == 0 ? 0 : top[layer - 1]; }
  double shear(const std::size_t layer) const { return moduli[layer] / (2 * (1 + poisson_ratio)); }

  /// Σ E ∫ (z − origin)^power dz from z upwards.
  double moment(const int power, const double origin, const double z) const
  {
    double sum = 0;
    for (std::size_t k = 0; k < top.size(); ++k)
    {
      const double low = std::max(z, bottom(k)) - origin, high = std::max(z, top[k]) - origin;
      sum += moduli[k] * (std::pow(high, power + 1) - std::pow(low, power + 1)) / (power + 1);
    }
    return sum;
  }
  double axis() const { return moment(1, 0, 0) / moment(0, 0, 0); }
  double stiffness() const { return moment(2, axis(), 0); } ///< EI of all layers [Nm²]
  /// Shear strain of the section by a unit force: ∫ τ²/G dz with the shear stress that the bending stresses ask for.
  double softness_in_shear() const
  {
    constexpr int n = 1000;
    double sum = 0;
    for (std::size_t k = 0; k < top.size(); ++k)
      for (int i = 0; i < n; ++i)
      {
        const double step = (top[k] - bottom(k)) / n;
        sum += step * std::pow(moment(1, axis(), bottom(k) + (i + 0.5) * step) / stiffness(), 2) / shear(k);
      }
    return sum;
  }

  /// @param law material of a modulus
  template <class Law>
  ExplicitBody body(const unsigned int n_elements, const Law &law) const
  {
    ExplicitBodyParameters parameters;
    parameters.kind.hourglass = Hourglass::bending;
    dealii::Triangulation<3> mesh;
    const dealii::Point<3> low(0, -0.5, 0), high(length, 0.5, top.back());
    dealii::GridGenerator::subdivided_hyper_rectangle(mesh, steps(n_elements), low, high, true);
    constexpr double everywhere = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < top.size(); ++k)
    {
      parameters.layers.insert({k, law(moduli[k])});
      set_material({{-everywhere, -everywhere, bottom(k)}, {everywhere, everywhere, top[k]}, unsigned(k)}, mesh);
    }
    return ExplicitBody(mesh, parameters);
  }

private:
  std::vector<std::vector<double>> steps(const unsigned int n_elements) const
  {
    std::vector<double> thickness;
    for (std::size_t k = 0; k < top.size(); ++k)
      thickness.push_back(top[k] - bottom(k));
    return {std::vector<double>(n_elements, length / n_elements), {1}, thickness};
  }
};

/// A bimetal whose thinner metal is eight times as stiff, and a sandwich of a soft core.
std::array<LayeredBeam, 2> layered_beams(const double poisson_ratio)
{
  return {LayeredBeam{{0.6, 1}, {young, 8 * young}, poisson_ratio},
          LayeredBeam{{0.15, 0.9, 1}, {young, 0.01 * young, 2 * young}, poisson_ratio}};
}

/// Nodes of an element's face at the end, if it has one.
bool is_at_end(const ExplicitBody &body, const unsigned int node)
{
  return body.node_position()[node][0] > length - 1e-6;
}

} // namespace

TEST_CASE("bending elements in layers: pure bending of a bimetal and a sandwich is that of plane sections, exactly",
          "[fe]")
{
  // Layers of one Poisson's ratio narrow alike, so the field of plane sections is the whole truth: a strain that is
  // even over an element's thickness, and pure bending about its middle.
  for (const double poisson_ratio : {0., 0.3, 0.499})
    for (const LayeredBeam &beam : layered_beams(poisson_ratio))
      for (const unsigned int n : {4u, 16u, 40u})
        for (const bool is_large : {false, true})
        {
          CAPTURE(poisson_ratio, beam.top.size(), n, is_large);
          const auto law = [&](const double modulus) -> Material
          {
            const ElasticParameters p{.young_modulus = modulus, .poisson_ratio = poisson_ratio, .density = heavy};
            return is_large ? Material(NeoHooke(p)) : Material(LinearElastic(p));
          };
          ExplicitBody body = beam.body(n, law);
          const double curvature = small_moment / beam.stiffness(), axis = beam.axis();
          std::map<unsigned int, double> held;
          for (const unsigned int node : body.boundary_nodes(0))
          {
            const double y = body.node_position()[node][1], z = body.node_position()[node][2] - axis;
            held[3 * node] = 0;
            held[3 * node + 1] = poisson_ratio * curvature * y * z;
            held[3 * node + 2] = 0.5 * curvature * poisson_ratio * (z * z - y * y);
          }
          // The stress −E κ z on the faces at the end: of each layer its mean, and its couple.
          std::vector<double> load(3 * body.n_nodes(), 0.);
          for (std::size_t e = 0; e < body.n_elements(); ++e)
          {
            const std::size_t layer = body.material_id(e);
            const double low = beam.bottom(layer) - axis, high = beam.top[layer] - axis, thickness = high - low;
            const double mean = -beam.moduli[layer] * curvature * 0.5 * (low + high) * thickness;
            const double couple = -beam.moduli[layer] * curvature * std::pow(thickness, 3) / 12;
            for (const unsigned int node : body.element_nodes(e))
              if (is_at_end(body, node))
              {
                const bool is_upper = body.node_position()[node][2] - axis > 0.5 * (low + high);
                load[3 * node] += mean / 4 + (is_upper ? 0.5 : -0.5) * couple / thickness;
              }
          }
          const double balance = 30 * rounding(law(young)); // of forces that differ more than those of one modulus
          bring_to_rest(body, load, held, balance);
          for (const unsigned int node : body.boundary_nodes(1))
          {
            const double y = body.node_position()[node][1], z = body.node_position()[node][2] - axis;
            const double sag = 0.5 * curvature * (length * length + poisson_ratio * (z * z - y * y));
            CHECK(body.displacement()[3 * node + 2] == Approx(sag).epsilon(2e-4));
          }
          const double greatest = 8 * young * curvature;
          for (std::size_t e = 0; e < body.n_elements(); ++e)
          {
            const std::size_t layer = body.material_id(e);
            const double middle = 0.5 * (beam.bottom(layer) + beam.top[layer]) - axis;
            CHECK(body.state_of(e).stress[0] ==
                  Approx(-beam.moduli[layer] * curvature * middle).margin(3 * balance * greatest));
          }
        }
}

TEST_CASE("bending elements in layers: a bimetal and a sandwich as cantilevers", "[fe]")
{
  for (const double poisson_ratio : {0.3, 0.499})
    for (const LayeredBeam &beam : layered_beams(poisson_ratio))
      for (const double ratio : {10., 5., 2.5, 1., 0.5})
      {
        CAPTURE(poisson_ratio, beam.top.size(), ratio);
        const unsigned int n = std::lround(length / ratio);
        const auto law = [&](const double modulus)
        { return LinearElastic({.young_modulus = modulus, .poisson_ratio = poisson_ratio, .density = heavy}); };
        ExplicitBody body = beam.body(n, law);
        std::map<unsigned int, double> held;
        const double curvature = small_moment / beam.stiffness(), axis = beam.axis();
        for (const unsigned int node : body.boundary_nodes(0))
        {
          const double y = body.node_position()[node][1], z = body.node_position()[node][2] - axis;
          held[3 * node] = 0;
          held[3 * node + 1] = poisson_ratio * curvature * y * z;
          held[3 * node + 2] = 0.5 * curvature * poisson_ratio * (z * z - y * y);
        }
        std::vector<double> load(3 * body.n_nodes(), 0.);
        const auto end = body.boundary_nodes(1);
        for (const unsigned int node : end)
          load[3 * node + 2] = small_force / end.size();
        bring_to_rest(body, load, held, 1e-7);
        double deflection = 0;
        for (const unsigned int node : end)
          deflection += body.displacement()[3 * node + 2] / end.size();
        const double bent = small_force * std::pow(length, 3) / (3 * beam.stiffness());
        const double sheared = small_force * length * beam.softness_in_shear();
        CAPTURE(deflection / (bent + sheared), sheared / bent);
        CHECK(deflection == Approx(bent * (1 - 0.25 / (n * n)) + sheared).epsilon(2e-3));
      }
}
