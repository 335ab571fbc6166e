// Orders of convergence by manufactured solutions: a displacement is chosen, and the forces that belong to it are
// applied. Roache, Code verification by the method of manufactured solutions, J. Fluids Eng. 124 (2002) 4-10. Expected:
// elements with all polynomials of degree p leave errors h^(p+1) in the displacement and h^p in its gradient, on any
// mesh of regular shape (Arnold, Boffi, Falk, Math. Comp. 71 (2002) 909-922); the leapfrog dt².

#include "fe_dealii/explicit_body.h"
#include "fe_dealii/mesh/box_mesh.h"
#include "fe_dealii/stable_step.h"
#include "tests/threads.h"
#include "tests/verification/fe_static.h"

#include <deal.II/base/function.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/numerics/vector_tools.h>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

using namespace bergamo::fe;

namespace
{

constexpr ElasticParameters soil{.young_modulus = 1e7, .poisson_ratio = 0.3, .density = 1600};

/// Standing waves d sin(a·x + φ) in several directions; under Hooke's law each needs the body force
/// ((λ + μ)(d·a) a + μ |a|² d) sin(a·x + φ).
struct Wave
{
  dealii::Tensor<1, 3> d, a;
  double phase;
};

const std::vector<Wave> &waves()
{
  static const std::vector<Wave> all{
      {dealii::Point<3>(1, 0.3, -0.2), dealii::Point<3>(2, 1, 0.5), 0.3},
      {dealii::Point<3>(-0.4, 0.8, 0.5), dealii::Point<3>(-0.7, 1.5, 1.8), 1.1},
      {dealii::Point<3>(0.2, -0.6, 0.9), dealii::Point<3>(1.2, -2.1, 0.9), 2.0},
  };
  return all;
}

class Displacement : public dealii::Function<3>
{
public:
  Displacement() : dealii::Function<3>(3) {}
  double value(const dealii::Point<3> &x, const unsigned int i) const override
  {
    double sum = 0;
    for (const auto &[d, a, phase] : waves())
      sum += d[i] * std::sin(a * x + phase);
    return sum;
  }
  dealii::Tensor<1, 3> gradient(const dealii::Point<3> &x, const unsigned int i) const override
  {
    dealii::Tensor<1, 3> sum;
    for (const auto &[d, a, phase] : waves())
      sum += d[i] * std::cos(a * x + phase) * a;
    return sum;
  }
};

class BodyForce : public dealii::Function<3>
{
public:
  explicit BodyForce(const LinearElastic &law)
      : dealii::Function<3>(3), lame(law.lame_modulus()), shear(law.shear_modulus())
  {
  }
  double value(const dealii::Point<3> &x, const unsigned int i) const override
  {
    double sum = 0;
    for (const auto &[d, a, phase] : waves())
      sum += ((lame + shear) * (d * a) * a[i] + shear * (a * a) * d[i]) * std::sin(a * x + phase);
    return sum;
  }

private:
  double lame, shear;
};

struct Errors
{
  double displacement, gradient; // L2 norms, relative
};

Errors static_errors(const unsigned int degree, const Hourglass hourglass, const unsigned int n)
{
  const LinearElastic law(soil);
  dealii::Triangulation<3> mesh;
  make_box({{0, 0, 0}, {1, 1, 1}, {n, n, n}}, mesh);
  dealii::GridTools::distort_random(0.2, mesh, /*keep_boundary=*/true, /*seed=*/11);
  ExplicitBodyParameters parameters;
  parameters.material = law;
  parameters.degree = degree;
  parameters.kind.hourglass = hourglass;
  ExplicitBody body(mesh, parameters);

  const Displacement exact;
  std::map<unsigned int, double> prescribed;
  for (unsigned int id = 0; id < 6; ++id)
    for (const unsigned int node : body.boundary_nodes(id))
      for (int i = 0; i < 3; ++i)
      {
        const auto &x = body.node_position()[node];
        prescribed[3 * node + i] = exact.value({x[0], x[1], x[2]}, i);
      }
  dealii::Vector<double> load(3 * body.n_nodes());
  dealii::VectorTools::create_right_hand_side(body.dof_handler(), dealii::QGauss<3>(degree + 2), BodyForce(law), load);
  bring_to_rest(body, {load.begin(), load.size()}, prescribed);

  // The forces of the explicit step are those of this equilibrium.
  body.compute_internal_force();
  double imbalance = 0;
  for (unsigned int dof = 0; dof < load.size(); ++dof)
    if (!prescribed.count(dof))
      imbalance = std::max(imbalance, std::abs(body.internal_force()[dof] - load[dof]));
  CHECK(imbalance < 1e-8 * load.linfty_norm());

  const auto norm = [&](const dealii::Vector<double> &u, const dealii::VectorTools::NormType type)
  {
    dealii::Vector<double> of_cells(body.n_elements());
    dealii::VectorTools::integrate_difference(body.dof_handler(), u, exact, of_cells, dealii::QGauss<3>(degree + 3),
                                              type);
    return of_cells.l2_norm();
  };
  const std::span<const double> displacement = body.displacement();
  const dealii::Vector<double> u(displacement.begin(), displacement.end()), zero(load.size());
  using dealii::VectorTools::H1_seminorm, dealii::VectorTools::L2_norm;
  return {norm(u, L2_norm) / norm(zero, L2_norm), norm(u, H1_seminorm) / norm(zero, H1_seminorm)};
}

} // namespace

TEST_CASE("A manufactured displacement on distorted meshes: orders 2 and 1 with 8 nodes, 3 and 2 with 27", "[fe]")
{
  for (const auto &[degree, hourglass] :
       {std::pair(1u, Hourglass::at_points), {1u, Hourglass::bending}, {2u, Hourglass::at_points}})
  {
    std::vector<double> displacement, gradient;
    for (const unsigned int n : degree == 1 ? std::array{4u, 8u, 16u} : std::array{2u, 4u, 8u})
    {
      const Errors errors = static_errors(degree, hourglass, n);
      displacement.push_back(errors.displacement);
      gradient.push_back(errors.gradient);
    }
    CAPTURE(degree, hourglass == Hourglass::bending, displacement, gradient);
    // The meshes are distorted at random, each in its way: their constants differ by some per cent, log2(1.1) = 0.14.
    CHECK(std::log2(displacement[1] / displacement[2]) == Approx(degree + 1).margin(0.15));
    CHECK(std::log2(gradient[1] / gradient[2]) == Approx(degree).margin(0.15));
  }
}

TEST_CASE("A manufactured motion with damping, gravity, forces and a moving face: second order in the time step",
          "[fe]")
{
  const Threads one(1);
  // u = U(X) sin ωt of the nodes needs f = m ü + α m u̇ + f_int(u) − weight: then all that remains is the error in time.
  // The internal forces are those of a second body that is put there, at large strain as well.
  constexpr ElasticParameters rubber{.young_modulus = 1e6, .poisson_ratio = 0.4, .density = 1100};
  const auto amplitude = [](const std::array<double, 3> &x, const int i)
  {
    const double along[3] = {0.15, 0.05, -0.1}, wave = std::sin(2 * x[1] + i) * std::cos(1.5 * x[2]);
    return 0.02 * (i + 1) + along[i] * x[0] + 0.05 * x[0] * wave; // the same on all of the face x = 0
  };
  for (const Material &material : {Material(LinearElastic(rubber)), Material(NeoHooke(rubber))})
    for (const unsigned int degree : {1u, 2u})
    {
      ExplicitBodyParameters parameters;
      parameters.material = material;
      parameters.degree = degree;
      parameters.gravity = {0.5, 0, -9.81};
      parameters.damping = 30;
      dealii::Triangulation<3> mesh;
      make_box({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}}, mesh);
      dealii::GridTools::distort_random(0.15, mesh, /*keep_boundary=*/true, /*seed=*/2);
      const double omega = 0.5 * p_wave_speed(material), end = 1.3 * 2 * std::numbers::pi / omega;
      std::vector<double> error;
      for (const int steps : {400, 800, 1600})
      {
        ExplicitBody body(mesh, parameters), reference(mesh, parameters);
        const double dt = end / steps;
        REQUIRE(dt < 0.7 * stable_step(body).time_step); // which a stretched body may not reach
        for (int i = 0; i < 3; ++i)
          body.prescribe_velocity(0u, i);
        std::vector<double> shape(3 * body.n_nodes());
        for (std::size_t dof = 0; dof < shape.size(); ++dof)
        {
          shape[dof] = amplitude(body.node_position()[dof / 3], dof % 3);
          body.velocity()[dof] = shape[dof] * omega * std::cos(0.5 * omega * dt);
        }
        for (int k = 0; k < steps; ++k)
        {
          const double t = k * dt, sine = std::sin(omega * t), cosine = std::cos(omega * t);
          for (std::size_t dof = 0; dof < shape.size(); ++dof)
            reference.displacement()[dof] = shape[dof] * sine;
          reference.compute_internal_force();
          for (std::size_t dof = 0; dof < shape.size(); ++dof)
            body.external_force()[dof] =
                reference.internal_force()[dof] - body.weight(dof) +
                body.mass()[dof] * shape[dof] * omega * (-omega * sine + parameters.damping * cosine);
          for (int i = 0; i < 3; ++i)
            body.set_velocity(MovingBody::Constraint(i), 0.02 * (i + 1) * omega * std::cos(omega * (t + 0.5 * dt)));
          body.compute_internal_force();
          body.kick(dt);
          body.drift(dt);
        }
        double worst = 0;
        for (std::size_t dof = 0; dof < shape.size(); ++dof)
          worst = std::max(worst, std::abs(body.displacement()[dof] - shape[dof] * std::sin(omega * end)));
        error.push_back(worst);
      }
      CAPTURE(material.index(), degree, error);
      CHECK(error[0] < 1e-3);
      CHECK(std::log2(error[0] / error[1]) == Approx(2).margin(0.1));
      CHECK(std::log2(error[1] / error[2]) == Approx(2).margin(0.1));
    }
}
