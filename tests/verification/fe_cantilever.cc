// Cantilever in plane strain under a shear force at its end, against the exact solution of Timoshenko & Goodier, Theory
// of Elasticity (1970), sec. 21, in the form of Augarde & Deeks, Finite Elem. Anal. Des. 44 (2008) 595-601: the
// parabola of shear at the end, the exact displacement at the root. Unlike pure bending (fe_locking.cc), the exact
// displacement is cubic, so no element holds it. Expected: errors h² with 8 nodes and h³ with 27, nearly incompressible
// too.

#include "fe_dealii/explicit_body.h"
#include "fe_dealii/mesh/box_mesh.h"
#include "tests/verification/fe_static.h"

#include <deal.II/base/function.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/grid/tria.h>
#include <deal.II/numerics/vector_tools.h>

#include <catch2/catch.hpp>

#include <cmath>
#include <span>

using namespace bergamo::fe;

namespace
{

constexpr double length = 4, depth = 1, thickness = 0.25, young = 1e7;
constexpr double inertia = depth * depth * depth / 12; // per thickness
constexpr double load = 1e3;                           // downwards, per thickness [N/m]

class Displacement : public dealii::Function<3>
{
public:
  explicit Displacement(const double poisson_ratio)
      : dealii::Function<3>(3), factor(load * (1 - poisson_ratio * poisson_ratio) / (6 * young * inertia)),
        nu(poisson_ratio / (1 - poisson_ratio))
  {
  }
  double value(const dealii::Point<3> &p, const unsigned int i) const override
  {
    const double x = p[0], y = p[1];
    if (i == 0)
      return factor * y * ((6 * length - 3 * x) * x + (2 + nu) * (y * y - depth * depth / 4));
    if (i == 1)
      return -factor *
             (3 * nu * y * y * (length - x) + (4 + 5 * nu) * depth * depth * x / 4 + (3 * length - x) * x * x);
    return 0;
  }

private:
  double factor, nu; // those of plane stress, for plane strain
};

double shear_stress(const double y)
{
  return -load / (2 * inertia) * (depth * depth / 4 - y * y);
}

class Shear : public dealii::Function<3>
{
public:
  Shear() : dealii::Function<3>(3) {}
  double value(const dealii::Point<3> &p, const unsigned int i) const override
  {
    return i == 1 ? shear_stress(p[1]) : 0;
  }
};

struct Errors
{
  double displacement; // L2 norm, relative
  double deflection;   // of the middle of the end, relative
  double bending;      // stress xx, root mean square over the elements' means, relative to the largest
  double shear;        // stress xy, the same
};

Errors errors_of(const unsigned int degree, const Hourglass hourglass, const unsigned int n_depth,
                 const double poisson_ratio)
{
  ExplicitBodyParameters parameters;
  parameters.degree = degree;
  parameters.kind.hourglass = hourglass;
  parameters.material = LinearElastic({.young_modulus = young, .poisson_ratio = poisson_ratio, .density = 1000});
  dealii::Triangulation<3> mesh;
  make_box({{0, -depth / 2, 0}, {length, depth / 2, thickness}, {4 * n_depth, n_depth, 1}}, mesh);
  ExplicitBody body(mesh, parameters);

  const Displacement exact(poisson_ratio);
  std::map<unsigned int, double> prescribed;
  for (unsigned int node = 0; node < body.n_nodes(); ++node)
  {
    const auto &x = body.node_position()[node];
    prescribed[3 * node + 2] = 0;
    if (x[0] == 0)
      for (unsigned int i = 0; i < 2; ++i)
        prescribed[3 * node + i] = exact.value({x[0], x[1], x[2]}, i);
  }
  dealii::Vector<double> force(3 * body.n_nodes());
  dealii::VectorTools::create_boundary_right_hand_side(body.dof_handler(), dealii::QGauss<2>(4), Shear(), force, {1});
  bring_to_rest(body, {force.begin(), force.size()}, prescribed);
  body.compute_internal_force();

  Errors errors{};
  const auto norm = [&](const dealii::Vector<double> &u)
  {
    dealii::Vector<double> of_cells(body.n_elements());
    dealii::VectorTools::integrate_difference(body.dof_handler(), u, exact, of_cells, dealii::QGauss<3>(degree + 3),
                                              dealii::VectorTools::L2_norm);
    return of_cells.l2_norm();
  };
  const std::span<const double> displacement = body.displacement();
  const dealii::Vector<double> u(displacement.begin(), displacement.end());
  errors.displacement = norm(u) / norm(dealii::Vector<double>(force.size()));
  for (unsigned int node = 0; node < body.n_nodes(); ++node)
    if (const auto &x = body.node_position()[node]; x[0] == length && std::abs(x[1]) < 1e-9 && x[2] == 0)
    {
      const double there = exact.value({x[0], x[1], x[2]}, 1);
      errors.deflection = std::abs(body.displacement()[3 * node + 1] / there - 1);
    }
  const double h = depth / n_depth;
  for (const auto &cell : body.dof_handler().active_cell_iterators())
  {
    const auto centre = cell->center();
    const Stress stress = body.state_of(cell->active_cell_index()).stress;
    const double mean_shear = shear_stress(centre[1]) + load / (2 * inertia) * h * h / 12;
    errors.bending += std::pow(stress[0] - load * (length - centre[0]) * centre[1] / inertia, 2);
    errors.shear += std::pow(stress[3] - mean_shear, 2);
  }
  errors.bending = std::sqrt(errors.bending / body.n_elements()) / (load * length * depth / 2 / inertia);
  errors.shear = std::sqrt(errors.shear / body.n_elements()) / std::abs(shear_stress(0));
  return errors;
}

} // namespace

TEST_CASE("Cantilever under a shear force: orders of convergence, nearly incompressible too", "[fe]")
{
  for (const auto &[degree, hourglass] :
       {std::pair(1u, Hourglass::at_points), {1u, Hourglass::bending}, {2u, Hourglass::at_points}})
  {
    double finest[2];
    for (const bool incompressible : {false, true})
    {
      std::vector<double> displacement, deflection, bending, shear;
      for (const unsigned int n : degree == 1 ? std::array{2u, 4u, 8u} : std::array{1u, 2u, 4u})
      {
        const Errors errors = errors_of(degree, hourglass, n, incompressible ? 0.499 : 0.3);
        displacement.push_back(errors.displacement);
        deflection.push_back(errors.deflection);
        bending.push_back(errors.bending);
        shear.push_back(errors.shear);
      }
      CAPTURE(degree, hourglass == Hourglass::bending, incompressible, displacement, deflection, bending, shear);
      CHECK(std::log2(displacement[1] / displacement[2]) == Approx(degree + 1).margin(0.1));
      // The deflection of a point may be better than the whole; stresses are due to order p, means over bricks gain the
      // next one. The means of the shear alone are so small that their order shows nothing.
      CHECK(std::log2(deflection[1] / deflection[2]) > degree + 0.75);
      // Elements that bend hold the bending: what is left comes from the root and is too small to have an order.
      if (hourglass == Hourglass::bending)
        CHECK(bending[2] < displacement[2]);
      else
        CHECK(std::log2(bending[1] / bending[2]) > degree + 0.75);
      CHECK(shear[2] < 2 * displacement[2]);
      finest[incompressible] = displacement[2];
    }
    // What locks is too stiff by a factor of the order of 1/(1 − 2ν) = 500 times the share of the error at ν = 0.3;
    // what does not has an error that depends on ν by factors of the order of one.
    CAPTURE(degree, hourglass == Hourglass::bending, finest[0], finest[1]);
    CHECK(finest[1] < 4 * finest[0]);
  }
}
