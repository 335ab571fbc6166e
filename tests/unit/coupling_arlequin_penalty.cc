#include "coupling/arlequin/penalty.h"
#include "coupling_arlequin_block.h"

#include <Eigen/Eigenvalues>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <numeric>
#include <omp.h>

using namespace bergamo::coupling;
using Vectors = std::vector<Eigen::Vector3d>;

namespace
{

constexpr double penalty = 1e14; // [Pa/m^2]

/// State of both models and the forces on them.
struct State
{
  Vectors particle, particle_force;
  std::vector<double> fe, fe_force;

  explicit State(const Overlap &overlap)
      : particle(overlap.n_particles(), Eigen::Vector3d::Zero()), particle_force(particle),
        fe(test::n_dofs(overlap), 0.), fe_force(fe)
  {
  }

  static State random(const Overlap &overlap, const unsigned seed)
  {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> uniform(-1e-4, 1e-4);
    State state(overlap);
    for (Eigen::Vector3d &u : state.particle)
      u = Eigen::Vector3d(uniform(random), uniform(random), uniform(random));
    for (double &u : state.fe)
      u = uniform(random);
    return state;
  }

  Eigen::Vector3d node_force(const int node) const { return Eigen::Map<const Eigen::Vector3d>(&fe_force[3 * node]); }

  PenaltyState compute(PenaltyCoupling &coupling)
  {
    std::fill(fe_force.begin(), fe_force.end(), 0.);
    return coupling.compute(particle, fe, particle_force, fe_force);
  }
};

void deform(const Overlap &overlap, State &state, const Eigen::Vector3d &shift, const Eigen::Matrix3d &gradient)
{
  for (std::size_t i = 0; i < overlap.n_particles(); ++i)
    state.particle[i] = shift + gradient * overlap.reference_position[i];
  for (std::size_t i = 0; i < overlap.n_nodes(); ++i)
    Eigen::Map<Eigen::Vector3d>(&state.fe[3 * overlap.nodes[i]]) = shift + gradient * overlap.node_position[i];
}

std::vector<double> values_in(const std::size_t n, const double from, const double to, const unsigned seed)
{
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform(from, to);
  std::vector<double> values(n);
  for (double &value : values)
    value = uniform(random);
  return values;
}

} // namespace

TEST_CASE("coupling forces and torques of both models balance")
{
  const Overlap overlap = test::block(3, 12);
  for (const Projection kind : {Projection::lumped, Projection::consistent})
  {
    PenaltyCoupling coupling(overlap, kind, penalty);
    State state = State::random(overlap, 11);
    CHECK(state.compute(coupling).energy > 0.);

    const Eigen::Vector3d about(0.7, 0.1, -0.4);
    Eigen::Vector3d force = Eigen::Vector3d::Zero(), torque = force;
    double forces = 0., torques = 0.;
    const auto add = [&](const Eigen::Vector3d &place, const Eigen::Vector3d &f)
    {
      force += f;
      torque += (place - about).cross(f);
      forces += f.norm();
      torques += (place - about).cross(f).norm();
    };
    for (std::size_t i = 0; i < overlap.n_particles(); ++i)
      add(overlap.reference_position[i], state.particle_force[i]);
    for (std::size_t i = 0; i < overlap.n_nodes(); ++i)
      add(overlap.node_position[i], state.node_force(overlap.nodes[i]));
    REQUIRE(forces > 0.);
    CHECK(force.norm() < 1e-14 * forces);
    CHECK(torque.norm() < 1e-14 * torques);

    // Nothing outside the coupling nodes, and forces are added.
    double all = 0., coupled = 0.;
    for (const double f : state.fe_force)
      all += std::abs(f);
    for (const int node : overlap.nodes)
      coupled += state.node_force(node).lpNorm<1>();
    CHECK(all == Approx(coupled).epsilon(1e-14));
    std::vector<double> twice(state.fe_force);
    coupling.compute(state.particle, state.fe, state.particle_force, twice);
    for (std::size_t i = 0; i < twice.size(); ++i)
      CHECK(twice[i] == 2. * state.fe_force[i]);
  }
}

TEST_CASE("a common rigid motion or homogeneous strain costs nothing")
{
  const Overlap overlap = test::block(3, 12);
  Eigen::Matrix3d spin, strain;
  spin << 0., -0.02, 0.01, 0.02, 0., -0.03, -0.01, 0.03, 0.;
  strain << 0.01, 0.004, 0.002, 0.004, -0.02, 0.007, 0.002, 0.007, 0.03;
  const Eigen::Vector3d shift(1e-3, -2e-3, 3e-3);
  for (const Projection kind : {Projection::lumped, Projection::consistent})
  {
    PenaltyCoupling coupling(overlap, kind, penalty);
    State state(overlap);
    for (const Eigen::Matrix3d &gradient : {Eigen::Matrix3d(Eigen::Matrix3d::Zero()), spin, strain})
    {
      deform(overlap, state, shift, gradient);
      CHECK(state.compute(coupling).largest_difference < 1e-13 * 1e-2);
    }
  }
}

TEST_CASE("the dissertation's lumped form resists a common homogeneous strain, ours does not")
{
  // Energy of the form Pi u - u^FE, compared with that of particles strained against a mesh at rest.
  const Overlap overlap = test::block(3, 12);
  const CoarseProjection projection(overlap, Projection::lumped);
  Eigen::Matrix3d strain;
  strain << 0.01, 0., 0., 0., -0.02, 0., 0., 0., 0.03;
  State state(overlap);
  deform(overlap, state, -strain * overlap.node_position.front(), strain);
  Vectors theirs(overlap.n_nodes());
  projection.project(state.particle, theirs);
  double largest = 0.;
  for (std::size_t i = 0; i < overlap.n_nodes(); ++i)
    largest = std::max(largest, (theirs[i] - Eigen::Map<Eigen::Vector3d>(&state.fe[3 * overlap.nodes[i]])).norm());
  // Off by the strain over a good part of an element's size of 0.01 m.
  CHECK(largest > 0.03 * 0.001);

  PenaltyCoupling coupling(overlap, Projection::lumped, penalty);
  CHECK(state.compute(coupling).largest_difference < 1e-10 * largest);
}

TEST_CASE("a rigid shift of the grains alone costs the penalty over their volume")
{
  const Overlap overlap = test::block(2, 15);
  const double volume = std::accumulate(overlap.particle_volume.begin(), overlap.particle_volume.end(), 0.);
  for (const Projection kind : {Projection::lumped, Projection::consistent})
  {
    PenaltyCoupling coupling(overlap, kind, penalty);
    State state(overlap);
    const Eigen::Vector3d shift(1e-6, 2e-6, -2e-6);
    std::fill(state.particle.begin(), state.particle.end(), shift);
    const PenaltyState result = state.compute(coupling);
    CHECK(result.energy == Approx(0.5 * penalty * 9e-12 * volume).epsilon(1e-10));
    CHECK(result.largest_difference == Approx(3e-6).epsilon(1e-10));
    Eigen::Vector3d on_particles = Eigen::Vector3d::Zero();
    for (const Eigen::Vector3d &f : state.particle_force)
      on_particles += f;
    CHECK((on_particles + penalty * volume * shift).norm() < 1e-10 * on_particles.norm());
  }
}

TEST_CASE("coupling forces are minus the gradient of the energy")
{
  const Overlap overlap = test::block(1, 12);
  for (const Projection kind : {Projection::lumped, Projection::consistent})
  {
    PenaltyCoupling coupling(overlap, kind, penalty);
    State state = State::random(overlap, 5);
    state.compute(coupling);
    const State at_rest = state;
    const double h = 1e-6; // the energy is quadratic: central differences are exact but for rounding
    double scale = 0.;
    for (const Eigen::Vector3d &f : at_rest.particle_force)
      scale = std::max(scale, f.norm());
    const auto slope = [&](double &u)
    {
      const double before = u;
      u = before + h;
      const double up = state.compute(coupling).energy;
      u = before - h;
      const double down = state.compute(coupling).energy;
      u = before;
      return (up - down) / (2. * h);
    };
    for (std::size_t i = 0; i < overlap.n_particles(); ++i)
      for (int c = 0; c < 3; ++c)
        CHECK(-slope(state.particle[i][c]) == Approx(at_rest.particle_force[i][c]).margin(1e-9 * scale));
    for (std::size_t dof = 0; dof < state.fe.size(); ++dof)
      CHECK(-slope(state.fe[dof]) == Approx(at_rest.fe_force[dof]).margin(1e-9 * scale));
  }
}

TEST_CASE("the coupling energy is never negative and equals the work of the forces")
{
  const Overlap overlap = test::block(2, 12);
  for (const Projection kind : {Projection::lumped, Projection::consistent})
  {
    PenaltyCoupling coupling(overlap, kind, penalty);
    for (unsigned seed = 0; seed < 50; ++seed)
    {
      State state = State::random(overlap, seed);
      const double energy = state.compute(coupling).energy;
      double work = 0.;
      for (std::size_t i = 0; i < state.particle.size(); ++i)
        work -= 0.5 * state.particle[i].dot(state.particle_force[i]);
      for (std::size_t i = 0; i < state.fe.size(); ++i)
        work -= 0.5 * state.fe[i] * state.fe_force[i];
      CHECK(energy >= 0.);
      CHECK(work == Approx(energy).epsilon(1e-10));
    }
  }
}

TEST_CASE("the eigenvalue of the coupling agrees with a dense solve")
{
  const Overlap overlap = test::block(2, 12);
  const std::vector<double> particle_mass = values_in(overlap.n_particles(), 1e-5, 3e-4, 1);
  const std::vector<double> fe_mass = values_in(test::n_dofs(overlap), 2e-5, 2e-4, 2);
  for (const Projection kind : {Projection::lumped, Projection::consistent})
    for (const bool with_fixed : {false, true})
    {
      PenaltyCoupling coupling(overlap, kind, penalty);
      std::vector<std::uint8_t> fixed(with_fixed ? fe_mass.size() : 0, 0);
      if (with_fixed)
        for (std::size_t i = 0; i < overlap.n_nodes(); i += 2)
          for (int c = 0; c < 3; ++c)
            fixed[3 * overlap.nodes[i] + c] = c != 1;

      // M^-1/2 K M^-1/2, column by column.
      const std::size_t n_p = 3 * overlap.n_particles(), n = n_p + fe_mass.size();
      const auto inverse_root = [&](const std::size_t i)
      {
        if (i < n_p)
          return 1. / std::sqrt(particle_mass[i / 3]);
        return with_fixed && fixed[i - n_p] ? 0. : 1. / std::sqrt(fe_mass[i - n_p]);
      };
      Eigen::MatrixXd matrix(n, n);
      for (std::size_t j = 0; j < n; ++j)
      {
        State state(overlap);
        (j < n_p ? state.particle[j / 3][j % 3] : state.fe[j - n_p]) = inverse_root(j);
        state.compute(coupling);
        for (std::size_t i = 0; i < n; ++i)
          matrix(i, j) = -inverse_root(i) * (i < n_p ? state.particle_force[i / 3][i % 3] : state.fe_force[i - n_p]);
      }
      CHECK((matrix - matrix.transpose()).norm() < 1e-12 * matrix.norm());
      const Eigen::VectorXd eigenvalues =
          Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrix, Eigen::EigenvaluesOnly).eigenvalues();
      const double exact = eigenvalues.maxCoeff();
      CHECK(eigenvalues.minCoeff() > -1e-12 * exact);

      const CoupledMasses masses{particle_mass, fe_mass, fixed};
      CHECK(coupling.largest_eigenvalue(masses, 1e-5) == Approx(exact).epsilon(3e-5));
      CHECK(coupling.largest_eigenvalue(masses) == Approx(exact).epsilon(3e-3));
      CHECK(coupling.stable_time_step(masses) == Approx(2. / std::sqrt(exact)).epsilon(2e-3));
    }
}

TEST_CASE("central differences just below the stable step stay bounded, just above they do not")
{
  const Overlap overlap = test::block(1, 12);
  const std::vector<double> particle_mass = values_in(overlap.n_particles(), 1e-5, 3e-4, 1);
  const std::vector<double> fe_mass = values_in(test::n_dofs(overlap), 1e-3, 4e-3, 2);
  PenaltyCoupling coupling(overlap, Projection::lumped, penalty);
  const double limit = coupling.stable_time_step({particle_mass, fe_mass, {}});
  const auto growth = [&](const double step)
  {
    State state = State::random(overlap, 9);
    State velocity(overlap);
    const double before = state.compute(coupling).energy;
    double energy = 0.;
    for (int n = 0; n < 2000; ++n)
    {
      energy = state.compute(coupling).energy;
      for (std::size_t i = 0; i < particle_mass.size(); ++i)
        state.particle[i] += step * (velocity.particle[i] += step / particle_mass[i] * state.particle_force[i]);
      for (std::size_t i = 0; i < fe_mass.size(); ++i)
        state.fe[i] += step * (velocity.fe[i] += step / fe_mass[i] * state.fe_force[i]);
    }
    return energy / before;
  };
  CHECK(growth(0.98 * limit) < 100.);
  CHECK_FALSE(growth(1.02 * limit) < 1e10);
}

TEST_CASE("coupling forces have the same bits on any number of threads")
{
  const Overlap overlap = test::block(7, 10); // long enough loops to be shared out
  const int before = omp_get_max_threads();
  for (const Projection kind : {Projection::lumped, Projection::consistent})
  {
    std::vector<State> states;
    std::vector<double> energies, eigenvalues;
    for (const int n_threads : {1, 2, 3})
    {
      omp_set_num_threads(n_threads);
      PenaltyCoupling coupling(overlap, kind, penalty);
      states.push_back(State::random(overlap, 21));
      energies.push_back(states.back().compute(coupling).energy);
      eigenvalues.push_back(coupling.largest_eigenvalue(
          {std::vector<double>(overlap.n_particles(), 1e-4), std::vector<double>(test::n_dofs(overlap), 1e-3), {}}));
    }
    for (std::size_t k = 1; k < states.size(); ++k)
    {
      CHECK(energies[k] == energies[0]);
      CHECK(eigenvalues[k] == eigenvalues[0]);
      CHECK(std::memcmp(states[k].fe_force.data(), states[0].fe_force.data(),
                        states[0].fe_force.size() * sizeof(double)) == 0);
      CHECK(std::memcmp(states[k].particle_force.data(), states[0].particle_force.data(),
                        states[0].particle_force.size() * sizeof(Eigen::Vector3d)) == 0);
    }
  }
  omp_set_num_threads(before);
}

TEST_CASE("bad input to the penalty coupling is named")
{
  const Overlap overlap = test::block(1, 12);
  for (const double bad : {0., -1., std::nan(""), HUGE_VAL})
    CHECK_THROWS_WITH(PenaltyCoupling(overlap, Projection::lumped, bad), Catch::Contains("must be positive"));
  CHECK_THROWS_WITH(PenaltyCoupling(Overlap(), Projection::lumped, penalty), Catch::Contains("0 nodes"));

  PenaltyCoupling coupling(overlap, Projection::lumped, penalty);
  State state(overlap);
  std::vector<double> small(9);
  CHECK_THROWS_WITH(coupling.compute(state.particle, small, state.particle_force, small),
                    Catch::Contains("9 displacements"));
  state.particle.pop_back();
  CHECK_THROWS_WITH(coupling.compute(state.particle, state.fe, state.particle_force, state.fe_force),
                    Catch::Contains("11 displacements and 12 forces for 12"));

  std::vector<double> particle_mass(12, 1.), fe_mass(test::n_dofs(overlap), 1.);
  fe_mass[3 * overlap.nodes[2] + 1] = 0.;
  CHECK_THROWS_WITH(coupling.largest_eigenvalue({particle_mass, fe_mass, {}}), Catch::Contains("the mass of node"));
  std::vector<std::uint8_t> fixed(fe_mass.size(), 0);
  fixed[3 * overlap.nodes[2] + 1] = 1;
  CHECK(std::isfinite(coupling.largest_eigenvalue({particle_mass, fe_mass, fixed})));
  particle_mass[4] = -1.;
  CHECK_THROWS_WITH(coupling.largest_eigenvalue({particle_mass, fe_mass, fixed}), Catch::Contains("particle 1028"));
}
