#include "coupling/arlequin/weight_transfer.h"
#include "tests/threads.h"
#include "tests/unit/coupling_arlequin_block.h"

#include <catch2/catch.hpp>

using namespace bergamo;
using namespace bergamo::coupling;

namespace
{

struct Loads
{
  std::vector<Eigen::Vector3d> force, torque;

  explicit Loads(const Overlap &overlap)
  {
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> uniform(-1., 1.);
    const auto vector = [&] { return Eigen::Vector3d(uniform(random), uniform(random), uniform(random)); };
    for (std::size_t particle = 0; particle < overlap.n_particles(); ++particle)
    {
      force.push_back(vector());
      torque.push_back(1e-3 * vector());
    }
  }
};

Eigen::Vector3d at_node(const Overlap &overlap, const std::vector<double> &fe_force, const std::size_t node)
{
  return Eigen::Map<const Eigen::Vector3d>(&fe_force[3 * overlap.nodes[node]]);
}

WeightTransfer transfer_of(const Overlap &overlap)
{
  return {std::make_shared<const ElementBlocks>(overlap), overlap.nodes};
}

} // namespace

TEST_CASE("what is taken from grains and given to nodes has the same sum and the same moment")
{
  const Overlap overlap = test::block(2, 9);
  const Loads loads(overlap);
  std::vector<double> fe_force(test::n_dofs(overlap), 0.);
  transfer_of(overlap).add_opposite(loads.force, loads.torque, fe_force);

  Eigen::Vector3d sum = Eigen::Vector3d::Zero(), moment = Eigen::Vector3d::Zero();
  double size = 0., turning = 0.;
  for (std::size_t particle = 0; particle < overlap.n_particles(); ++particle)
  {
    const Eigen::Vector3d &f = loads.force[particle];
    const Eigen::Vector3d m = overlap.reference_position[particle].cross(f) + loads.torque[particle];
    sum += f;
    moment += m;
    size += f.norm();
    turning += m.norm();
  }
  REQUIRE(moment.norm() > 1e-3 * turning);
  for (std::size_t node = 0; node < overlap.n_nodes(); ++node)
  {
    sum += at_node(overlap, fe_force, node);
    moment += overlap.node_position[node].cross(at_node(overlap, fe_force, node));
  }
  CHECK(sum.norm() < 1e-14 * size); // rounding of a hundred terms
  CHECK(moment.norm() < 1e-14 * turning);
}

TEST_CASE("a couple on a grain moves the nodes like a spin")
{
  // In a homogeneous motion of velocity gradient L its power is that of the spin, t . curl v / 2.
  const Overlap overlap = test::block(1, 12);
  const Loads loads(overlap);
  const std::vector<Eigen::Vector3d> none(overlap.n_particles(), Eigen::Vector3d::Zero());
  std::vector<double> fe_force(test::n_dofs(overlap), 0.);
  transfer_of(overlap).add_opposite(none, loads.torque, fe_force);
  Eigen::Matrix3d gradient;
  gradient << 0.3, -0.2, 0.5, 0.7, 0.1, -0.4, 0.6, 0.9, -0.8;
  const Eigen::Vector3d curl(gradient(2, 1) - gradient(1, 2), gradient(0, 2) - gradient(2, 0),
                             gradient(1, 0) - gradient(0, 1));
  double power = 0., of_spin = 0., size = 0.;
  for (std::size_t node = 0; node < overlap.n_nodes(); ++node)
    power += at_node(overlap, fe_force, node).dot(gradient * overlap.node_position[node]);
  for (const Eigen::Vector3d &torque : loads.torque)
  {
    of_spin -= 0.5 * torque.dot(curl);
    size += torque.norm();
  }
  CHECK(power == Approx(of_spin).margin(1e-13 * size));
}

TEST_CASE("a transfer has the same bits on any number of threads")
{
  const Overlap overlap = test::block(6, 8);
  const Loads loads(overlap);
  const auto forces = [&](const int n_threads)
  {
    const Threads threads(n_threads);
    std::vector<double> fe_force(test::n_dofs(overlap), 0.);
    transfer_of(overlap).add_opposite(loads.force, loads.torque, fe_force);
    return fe_force;
  };
  const std::vector<double> one = forces(1);
  CHECK(forces(2) == one);
  CHECK(forces(3) == one);
}
