#include "coupling/arlequin/penalty.h"
#include "coupling/arlequin/weight.h"
#include "tests/unit/coupling_arlequin_block.h"

#include <catch2/catch.hpp>

using namespace bergamo::coupling;

/// An overlap that is made anew while forces act in it.
namespace
{

using Vectors = std::vector<Eigen::Vector3d>;

Vectors random_vectors(const std::size_t n, const double size, const unsigned seed)
{
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform(-size, size);
  Vectors vectors(n);
  for (auto &v : vectors)
    v = Eigen::Vector3d(uniform(random), uniform(random), uniform(random));
  return vectors;
}

/// The particles of an overlap from one on, and the nodes in another order.
Overlap part_of(const Overlap &whole, const std::size_t first)
{
  Overlap part;
  const int n_nodes = static_cast<int>(whole.n_nodes());
  part.nodes.assign(whole.nodes.rbegin(), whole.nodes.rend());
  part.node_position.assign(whole.node_position.rbegin(), whole.node_position.rend());
  for (std::size_t particle = first; particle < whole.n_particles(); ++particle)
  {
    part.particle_id.push_back(whole.particle_id[particle]);
    part.particle_volume.push_back(whole.particle_volume[particle]);
    part.reference_position.push_back(whole.reference_position[particle]);
    for (std::size_t k = whole.shape_offset[particle]; k < whole.shape_offset[particle + 1]; ++k)
    {
      part.shape_node.push_back(n_nodes - 1 - whole.shape_node[k]);
      part.shape_value.push_back(whole.shape_value[k]);
      part.shape_gradient.push_back(whole.shape_gradient[k]);
    }
    part.shape_offset.push_back(part.shape_node.size());
  }
  return part;
}

/// A block whose lower grains are held.
PenaltyCoupling held_block(const Overlap &overlap, const Projection kind)
{
  std::vector<double> node_weight;
  for (const auto &x : overlap.node_position)
    node_weight.push_back(std::clamp((x.z() - overlap.node_position[0].z()) / 0.02, 0., 1.));
  PenaltyCoupling coupling(overlap, kind, 1e14);
  HeldEdge edge(overlap, node_weight, particle_weights(overlap, node_weight), {.depth = 1., .stiffness = 1e15});
  edge.dead_load = random_vectors(edge.size(), 1e-2, 4);
  coupling.hold(std::move(edge));
  return coupling;
}

struct Loads
{
  Vectors particle;
  std::vector<double> fe;
  PenaltyState state;

  Loads(PenaltyCoupling &coupling, const Vectors &displacement, const std::vector<double> &fe_displacement)
      : particle(displacement.size()), fe(fe_displacement.size(), 0.)
  {
    state = coupling.compute(displacement, fe_displacement, particle, fe);
  }
};

} // namespace

TEST_CASE("forces and energy of an overlap that is made anew go on without a jump")
{
  const Projection kind = GENERATE(Projection::lumped, Projection::consistent);
  const Overlap overlap = test::block(2, 20);
  PenaltyCoupling coupling = held_block(overlap, kind);
  REQUIRE(coupling.edge().size() > 5);
  Vectors u = random_vectors(overlap.n_particles(), 1e-6, 1);
  std::vector<double> fe(test::n_dofs(overlap));
  for (std::size_t dof = 0; dof < fe.size(); ++dof)
    fe[dof] = 1e-6 * std::sin(7. * static_cast<double>(dof));
  const Loads before(coupling, u, fe);

  // Places from which displacements count anew: those that leave no difference.
  Vectors moved(overlap.n_particles());
  for (std::size_t i = 0; i < moved.size(); ++i)
  {
    Eigen::Vector3d of_body = Eigen::Vector3d::Zero();
    for (std::size_t k = overlap.shape_offset[i]; k < overlap.shape_offset[i + 1]; ++k)
      of_body += overlap.shape_value[k] * Eigen::Map<const Eigen::Vector3d>(
                                              &fe[3 * static_cast<std::size_t>(overlap.nodes[overlap.shape_node[k]])]);
    moved[i] = u[i] - of_body;
    u[i] = of_body;
  }
  coupling.renew(part_of(overlap, 0), moved);
  CHECK(coupling.n_renewals() == 1);
  const Loads after(coupling, u, fe);
  double scale = 0.;
  for (const auto &f : before.particle)
    scale = std::max(scale, f.norm());
  for (std::size_t i = 0; i < u.size(); ++i)
    CHECK((after.particle[i] - before.particle[i]).norm() < 1e-11 * scale);
  for (std::size_t dof = 0; dof < fe.size(); ++dof)
    CHECK(std::abs(after.fe[dof] - before.fe[dof]) < 1e-11 * scale);
  CHECK(after.state.energy == Approx(before.state.energy).epsilon(1e-12));
  CHECK(after.state.largest_motion < 1e-18);

  // From there on the energy takes the work of the forces.
  const Vectors way = random_vectors(u.size(), 1e-9, 2);
  double work = 0.;
  for (std::size_t i = 0; i < u.size(); ++i)
    u[i] += way[i];
  const Loads later(coupling, u, fe);
  for (std::size_t i = 0; i < u.size(); ++i)
    work += 0.5 * (after.particle[i] + later.particle[i]).dot(way[i]);
  CHECK(after.state.energy - later.state.energy == Approx(work).epsilon(1e-6));
}

TEST_CASE("particles that are no more in an overlap have no load and their share of the edge is let go")
{
  const Overlap overlap = test::block(2, 20);
  PenaltyCoupling coupling = held_block(overlap, Projection::lumped);
  const std::size_t gone = 100, held = coupling.edge().size();
  Vectors u = random_vectors(overlap.n_particles(), 1e-6, 1);
  const std::vector<double> fe(test::n_dofs(overlap), 0.);
  const double energy = Loads(coupling, u, fe).state.energy;
  const Overlap rest = part_of(overlap, gone);
  coupling.renew(rest, Vectors(u.begin() + gone, u.end()));
  CHECK(coupling.edge().size() < held);
  for (const int particle : coupling.edge().particles())
    REQUIRE(particle < static_cast<int>(rest.n_particles()));
  const Vectors still(rest.n_particles(), Eigen::Vector3d::Zero());
  const Loads after(coupling, still, fe);
  CHECK(after.state.energy == Approx(energy).epsilon(1e-12)); // nothing is lost from the account
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const auto &f : after.particle)
    sum += f;
  for (std::size_t dof = 0; dof < fe.size(); ++dof)
    sum[static_cast<int>(dof % 3)] += after.fe[dof];
  CHECK(sum.norm() < 1e-12 * after.particle[0].norm() * static_cast<double>(rest.n_particles()));
}
