#include "coupling/arlequin/penalty.h"

#include "dem/core/error.h"
#include "dem/core/parallel.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <unordered_map>

namespace bergamo::coupling
{

namespace
{

constexpr int max_iterations = 20000;

template <class... Parts>
[[noreturn]] void fail(const Parts &...parts)
{
  reject("penalty coupling: ", parts...);
}

/// Numbers in [-1, 1] that look random and are always the same (splitmix64).
double scattered(std::uint64_t i)
{
  i = (i + 1) * 0x9e3779b97f4a7c15u;
  i = (i ^ (i >> 30)) * 0xbf58476d1ce4e5b9u;
  i = (i ^ (i >> 27)) * 0x94d049bb133111ebu;
  return static_cast<double>((i ^ (i >> 31)) >> 11) * 0x1p-52 - 1.;
}

} // namespace

PenaltyCoupling::PenaltyCoupling(Overlap overlap, const Projection kind, const double penalty)
    : kind_(kind), penalty_(penalty)
{
  take(std::move(overlap));
  if (!(penalty > 0.) || !std::isfinite(penalty))
    fail("the penalty is ", penalty, " Pa/m^2; it must be positive, e.g. ten times the continuum's modulus over the ",
         "product of grain size and element size");
}

void PenaltyCoupling::take(Overlap overlap)
{
  projection_ = std::make_unique<const CoarseProjection>(overlap, kind_); // looks whether it is a good one
  overlap_ = std::move(overlap);
  largest_node_ = *std::max_element(overlap_.nodes.begin(), overlap_.nodes.end());
  for (std::vector<Eigen::Vector3d> *values : {&moment_, &density_, &node_load_})
    values->resize(overlap_.n_nodes());
  largest_motion_.resize(projection_->blocks()->blocks().size());
  difference_.assign(overlap_.n_nodes(), Eigen::Vector3d::Zero());
  kept_.assign(overlap_.n_nodes(), Eigen::Vector3d::Zero());
}

void PenaltyCoupling::renew(Overlap overlap, const std::span<const Eigen::Vector3d> moved)
{
  std::unordered_map<int, Eigen::Vector3d> density; // by node of the mesh
  for (std::size_t i = 0; i < overlap_.n_nodes(); ++i)
    density.emplace(overlap_.nodes[i], kept_[i] + penalty_ * difference_[i]);
  ++n_renewals_;
  put_in_ += difference_energy_;
  difference_energy_ = 0.;
  put_in_ += edge_.renew(overlap, moved);
  take(std::move(overlap));
  for (std::size_t i = 0; i < overlap_.n_nodes(); ++i)
    if (const auto found = density.find(overlap_.nodes[i]); found != density.end())
      kept_[i] = found->second;
}

PenaltyState PenaltyCoupling::compute(const std::span<const Eigen::Vector3d> particle_displacement,
                                      const std::span<const double> fe_displacement,
                                      const std::span<Eigen::Vector3d> particle_force, const std::span<double> fe_force)
{
  const std::size_t n_particles = overlap_.n_particles();
  if (particle_displacement.size() != n_particles || particle_force.size() != n_particles)
    fail(particle_displacement.size(), " displacements and ", particle_force.size(), " forces for ", n_particles,
         " coupled particles");
  std::fill(particle_force.begin(), particle_force.end(), Eigen::Vector3d::Zero());
  return compute([&](const std::size_t particle) -> const Eigen::Vector3d & { return particle_displacement[particle]; },
                 fe_displacement,
                 [&](const std::size_t particle, const Eigen::Vector3d &force) { particle_force[particle] += force; },
                 fe_force);
}

void PenaltyCoupling::require_nodes(const std::span<const double> fe_displacement,
                                    const std::span<const double> fe_force) const
{
  if (fe_displacement.size() < 3 * (static_cast<std::size_t>(largest_node_) + 1) ||
      fe_force.size() != fe_displacement.size())
    fail(fe_displacement.size(), " displacements and ", fe_force.size(),
         " forces of the elements; one size is needed, for nodes up to number ", largest_node_);
}

/// From the particles' moments to the differences and the load densities, and to what these give to the nodes.
/// @return energy stored [J]
double PenaltyCoupling::load_nodes(const std::span<double> fe_force, const Loads loads)
{
  difference_ = moment_;
  projection_->divide(difference_);
  const bool keeps = loads == Loads::all && n_renewals_ > 0;
  double stored = 0.;
  for (std::size_t i = 0; i < overlap_.n_nodes(); ++i)
  {
    const Eigen::Vector3d half = 0.5 * penalty_ * difference_[i];
    density_[i] = keeps ? Eigen::Vector3d(kept_[i] + half) : half;
    stored += density_[i].dot(moment_[i]); // sum of V u.N^T (kept + epsilon r / 2) over the particles
    density_[i] += half;
  }
  projection_->multiply(density_, node_load_); // opposite to the particles' forces, at the same places
  for (std::size_t i = 0; i < overlap_.n_nodes(); ++i)
    Eigen::Map<Eigen::Vector3d>(fe_force.data() + 3 * overlap_.nodes[i]) += node_load_[i];
  return stored;
}

PenaltyState PenaltyCoupling::state_of(const double stored, const double held, const Loads loads)
{
  PenaltyState state;
  state.energy = stored + held;
  for (const Eigen::Vector3d &r : difference_)
    state.largest_difference = std::max(state.largest_difference, r.norm());
  for (const double motion : largest_motion_)
    state.largest_motion = std::max(state.largest_motion, motion);
  if (loads == Loads::all)
  {
    difference_energy_ = stored;
    state.energy += put_in_;
  }
  return state;
}

double PenaltyCoupling::largest_eigenvalue(const CoupledMasses &masses, const double tolerance)
{
  const std::size_t n_particles = overlap_.n_particles(), n_nodes = overlap_.n_nodes();
  if (masses.particle.size() != n_particles)
    fail(masses.particle.size(), " masses for ", n_particles, " coupled particles");
  if (masses.fe.size() < 3 * (static_cast<std::size_t>(largest_node_) + 1) ||
      (!masses.fixed.empty() && masses.fixed.size() != masses.fe.size()))
    fail(masses.fe.size(), " masses and ", masses.fixed.size(),
         " marks of prescribed motion for the elements; give one a degree of freedom, for nodes up to number ",
         largest_node_);

  // Symmetric form M^-1/2 K M^-1/2 x, x = particles and then coupling nodes.
  const std::size_t n = n_particles + n_nodes;
  std::vector<Eigen::Vector3d> inverse_root(n);
  for (std::size_t i = 0; i < n; ++i)
    for (int c = 0; c < 3; ++c)
    {
      const std::size_t dof = i < n_particles ? 0 : 3 * overlap_.nodes[i - n_particles] + c;
      const double mass = i < n_particles ? masses.particle[i] : masses.fe[dof];
      const bool fixed = i >= n_particles && !masses.fixed.empty() && masses.fixed[dof] != 0;
      if (!fixed && !(mass > 0.))
        fail("the mass of ",
             i < n_particles ? "particle " + std::to_string(overlap_.particle_id[i])
                             : "node " + std::to_string(overlap_.nodes[i - n_particles]),
             " is ", mass, " kg; weighted masses must be positive");
      inverse_root[i][c] = fixed ? 0. : 1. / std::sqrt(mass);
    }

  std::vector<Eigen::Vector3d> x(n), y(n), particle_displacement(n_particles), particle_force(n_particles);
  std::vector<double> fe_displacement(masses.fe.size(), 0.), fe_force(masses.fe.size());
  for (std::size_t i = 0; i < n; ++i)
    for (int c = 0; c < 3; ++c)
      x[i][c] = inverse_root[i][c] == 0. ? 0. : scattered(3 * i + c);

  double eigenvalue = 0., residual = 0.;
  for (int iteration = 0; iteration < max_iterations; ++iteration)
  {
    double norm = 0.;
    for (std::size_t i = 0; i < n; ++i)
      norm += x[i].squaredNorm();
    norm = std::sqrt(norm);
    if (norm == 0.)
      return 0.;
    for (std::size_t i = 0; i < n; ++i)
    {
      x[i] /= norm;
      const Eigen::Vector3d displacement = inverse_root[i].cwiseProduct(x[i]);
      if (i < n_particles)
        particle_displacement[i] = displacement;
      else
        std::copy_n(displacement.data(), 3, &fe_displacement[3 * overlap_.nodes[i - n_particles]]);
    }
    std::fill(fe_force.begin(), fe_force.end(), 0.);
    std::fill(particle_force.begin(), particle_force.end(), Eigen::Vector3d::Zero());
    add_forces([&](const std::size_t i) -> const Eigen::Vector3d & { return particle_displacement[i]; },
               fe_displacement, [&](const std::size_t i, const Eigen::Vector3d &force) { particle_force[i] += force; },
               fe_force, Loads::linear);

    eigenvalue = 0.;
    for (std::size_t i = 0; i < n; ++i)
    {
      const double *const force =
          i < n_particles ? particle_force[i].data() : &fe_force[3 * overlap_.nodes[i - n_particles]];
      y[i] = -inverse_root[i].cwiseProduct(Eigen::Map<const Eigen::Vector3d>(force));
      eigenvalue += x[i].dot(y[i]);
    }
    residual = 0.;
    for (std::size_t i = 0; i < n; ++i)
      residual += (y[i] - eigenvalue * x[i]).squaredNorm();
    residual = std::sqrt(residual);
    if (residual <= tolerance * eigenvalue)
      break;
    x.swap(y);
  }
  return eigenvalue + residual;
}

double PenaltyCoupling::stable_time_step(const CoupledMasses &masses)
{
  const double eigenvalue = largest_eigenvalue(masses);
  return eigenvalue > 0. ? 2. / std::sqrt(eigenvalue) : std::numeric_limits<double>::infinity();
}

} // namespace bergamo::coupling
