#include "fe_dealii/element/small_strain_enhanced.h"

#include "dem/core/error.h"
#include "fe_dealii/element/hexahedron.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace bergamo::fe
{
namespace
{

using enhanced::n_all_dofs, enhanced::n_dofs, enhanced::n_inner_dofs, enhanced::n_nodes;
using Inner = Eigen::Matrix<double, n_inner_dofs, 1>;
using InnerMatrix = Eigen::Matrix<double, n_inner_dofs, n_inner_dofs, Eigen::RowMajor>;

bool is_uniform(const Points (&stress)[6])
{
  constexpr double rounding = 1e-13;
  double greatest = 0, spread = 0;
  for (const Points &component : stress)
  {
    const double low = math::least(component), high = -math::least(-component);
    greatest = std::max({greatest, std::abs(low), std::abs(high)});
    spread = std::max(spread, high - low);
  }
  return spread <= rounding * greatest;
}

/// Twice an upper bound on the elastic energy of stresses at the softest direction, ∫ σ:σ/2G dV [J].
double energy_scale(const Points &volume, const Points (&stress)[6], const double shear_modulus)
{
  Points square = 2. * (stress[3] * stress[3] + stress[4] * stress[4] + stress[5] * stress[5]);
  for (int i = 0; i < 3; ++i)
    square += stress[i] * stress[i];
  return sum(volume * square) / (2 * shear_modulus);
}

} // namespace

template <class Law>
struct SmallStrainEnhanced<Law>::Step
{
  Points strain[6]; // increment
  PointHistory history;
  Sector sector[points_per_pack];
  Inner inner; // displacement increment of the modes
  bool is_balanced = true;
};

template <class Law>
SmallStrainEnhanced<Law>::SmallStrainEnhanced(const Law &law, std::vector<unsigned int> nodes,
                                              std::vector<enhanced::Geometry> geometry, std::vector<PointHistory> start)
    : SmallStrainElements<Law>(law, n_nodes, std::move(nodes), std::move(start)), geometry_(std::move(geometry)),
      inner_displacement_(n_inner_dofs * geometry_.size(), 0.), n_unbalanced_(geometry_.size(), 0.),
      unbalanced_force_(inner_displacement_), unbalanced_work_(n_unbalanced_)
{
  find_inverses();
  find_start_force();
}

template <class Law>
void SmallStrainEnhanced<Law>::find_inverses()
{
  inverse_.resize(this->size());
  for (std::size_t e = 0; e < this->size(); ++e)
  {
    enhanced::stiffness<n_nodes>(
        geometry_[e],
        [&](const Points(&unit_strain)[6], Points(&stress)[6]) { elastic_stress(this->law(), unit_strain, stress); },
        inverse_[e].data());
    inverse_[e] = enhanced::inverse(inverse_[e]);
  }
}

template <class Law>
void SmallStrainEnhanced<Law>::find_start_force()
{
  start_force_.assign(n_all_dofs * this->size(), 0.);
  bool is_even = true;
  for (std::size_t e = 0; e < this->size(); ++e)
  {
    const Points(&stress)[6] = this->history(e, 0).stress;
    is_even &= is_uniform(stress);
    enhanced::start_force(geometry_[e], stress, &start_force_[n_all_dofs * e]);
  }
  if (is_even)
    start_force_.clear();
  start_energy_.assign(start_force_.empty() ? 0 : this->size(), 0.);
}

template <class Law>
auto SmallStrainEnhanced<Law>::find_step(const std::size_t element, const double *increment) const -> Step
{
  constexpr int broyden_iterations = 15; // before the consistent stiffness is asked, which costs more
  constexpr int newton_iterations = 12;
  const enhanced::Geometry &geometry = geometry_[element];
  const PointHistory &old = this->history(element, 0);
  Points of_nodes[6];
  enhanced::strain<0, n_nodes>(geometry, increment, of_nodes);

  Step step;
  Inner force;
  const auto go_to = [&](const Inner &inner)
  {
    step.inner = inner;
    enhanced::strain<n_nodes>(geometry, inner.data(), step.strain);
    for (int i = 0; i < 6; ++i)
      step.strain[i] += of_nodes[i];
    step.history = old;
    update_stress(this->law(), geometry.volume, step.strain, step.history, step.sector);
    enhanced::internal_force<n_nodes>(geometry, step.history.stress, force.data());
    for (int k = 0; k < n_inner_dofs; ++k)
      force[k] += start_force(element, n_dofs + k);
  };

  const double stiffness = this->stiffness_factor(element);
  const Eigen::Map<const InnerMatrix, Eigen::Unaligned> elastic(inverse_[element].data());
  go_to(Inner::Zero());
  if constexpr (std::is_same_v<Law, LinearElastic>)
  {
    go_to(-elastic * force);
    return step;
  }
  const double scale = energy_scale(geometry.volume, step.history.stress, this->law().shear_modulus()) +
                       energy_scale(geometry.volume, old.stress, this->law().shear_modulus());
  const double bearable = tolerance * tolerance * scale;
  const auto out_of_balance = [&] { return force.dot(elastic * force) / stiffness; };
  double error = out_of_balance(), least = error;
  Inner best = step.inner;
  const auto go_on = [&](const Inner &inner)
  {
    go_to(inner);
    error = out_of_balance();
    if (error < least)
    {
      least = error;
      best = inner;
    }
  };

  InnerMatrix inverse = elastic / stiffness;
  for (int iteration = 0; !(error <= bearable) && iteration < broyden_iterations; ++iteration)
  {
    const Inner path = -inverse * force, force_before = force;
    const double error_before = error;
    go_on(step.inner + path);
    const Inner change = force - force_before;
    const Eigen::Matrix<double, 1, n_inner_dofs> left = path.transpose() * inverse;
    const double denominator = left * change;
    if (error > 4 * error_before || !(std::abs(denominator) > 1e-8 * path.squaredNorm()))
      inverse = elastic / stiffness;
    else
      inverse += (path - inverse * change) * left / denominator;
  }
  if (!(error <= bearable))
    go_on(best);
  for (int iteration = 0; !(error <= bearable); ++iteration)
  {
    if (iteration == newton_iterations || !std::isfinite(error))
    {
      go_to(best);
      step.is_balanced = false;
      break;
    }
    Points moduli[6][6];
    InnerMatrix matrix;
    this->tangent_moduli(element, 0, step.strain, moduli);
    enhanced::stiffness<n_nodes>(
        geometry, [&](const Points(&unit_strain)[6], Points(&stress)[6]) { apply_moduli(moduli, unit_strain, stress); },
        matrix.data());
    const Inner from = step.inner, path = -matrix.completeOrthogonalDecomposition().solve(force),
                elastic_path = -elastic * force / stiffness;
    const double error_before = error;
    double share = 1;
    do
      go_on(from + share * path);
    while (!(error < error_before) && (share *= 0.5) > 0.03);
    if (error < error_before)
      continue;
    // Where points flow without any stiffness, down the potential instead, as far as the forces push.
    double length = 0.5;
    do
      go_on(from + (length *= 2) * elastic_path);
    while (force.dot(elastic_path) < 0 && length < 1e6);
  }
  return step;
}

template <class Law>
std::optional<std::size_t> SmallStrainEnhanced<Law>::compute_forces(const std::size_t begin, const std::size_t end,
                                                                    const double *displacement, const double *before)
{
  for (std::size_t e = begin; e < end; ++e)
  {
    if (this->is_rigid(e))
      continue;
    double increment[n_dofs];
    this->gather_increment(e, displacement, before, increment);
    const Step step = find_step(e, increment);
    this->history(e, 0) = step.history;
    std::copy_n(step.sector, points_per_pack, this->sectors(e, 0));
    for (int k = 0; k < n_inner_dofs; ++k)
      inner_displacement_[n_inner_dofs * e + k] += step.inner[k];
    book_unbalanced(e, step);
    enhanced::internal_force<0, n_nodes>(geometry_[e], step.history.stress, this->force(e));
    if (!start_force_.empty())
      add_start_force(e, displacement);
  }
  return std::nullopt;
}

template <class Law>
void SmallStrainEnhanced<Law>::book_unbalanced(const std::size_t element, const Step &step)
{
  double *const force = &unbalanced_force_[n_inner_dofs * element];
  const std::array<double, n_inner_dofs> now =
      step.is_balanced ? std::array<double, n_inner_dofs>{} : inner_force(element);
  for (int k = 0; k < n_inner_dofs; ++k)
  {
    unbalanced_work_[element] += 0.5 * (force[k] + now[k]) * step.inner[k];
    force[k] = now[k];
  }
  n_unbalanced_[element] += !step.is_balanced;
}

template <class Law>
double SmallStrainEnhanced<Law>::stiffness_loss() const
{
  return SmallStrainElements<Law>::stiffness_loss() -
         std::accumulate(unbalanced_work_.begin(), unbalanced_work_.end(), 0.);
}

template <class Law>
void SmallStrainEnhanced<Law>::add_start_force(const std::size_t element, const double *displacement)
{
  double u[n_dofs], energy = 0;
  this->gather(element, displacement, u);
  double *const force = this->force(element);
  for (int dof = 0; dof < n_dofs; ++dof)
  {
    force[dof] += start_force(element, dof);
    energy += start_force(element, dof) * u[dof];
  }
  for (int k = 0; k < n_inner_dofs; ++k)
    energy += start_force(element, n_dofs + k) * inner_displacement_[n_inner_dofs * element + k];
  start_energy_[element] = energy;
}

template <class Law>
std::array<double, n_inner_dofs> SmallStrainEnhanced<Law>::inner_force(const std::size_t element) const
{
  std::array<double, n_inner_dofs> result;
  enhanced::internal_force<n_nodes>(geometry_[element], this->history(element, 0).stress, result.data());
  for (int k = 0; k < n_inner_dofs; ++k)
    result[k] += start_force(element, n_dofs + k);
  return result;
}

template <class Law>
std::size_t SmallStrainEnhanced<Law>::n_unbalanced() const
{
  return std::accumulate(n_unbalanced_.begin(), n_unbalanced_.end(), 0.);
}

template <class Law>
double SmallStrainEnhanced<Law>::elastic_energy() const
{
  return std::accumulate(start_energy_.begin(), start_energy_.end(), SmallStrainElements<Law>::elastic_energy());
}

template <class Law>
std::vector<std::pair<std::string, std::span<double>>> SmallStrainEnhanced<Law>::state()
{
  auto views = SmallStrainElements<Law>::state();
  views.push_back({"element_inner_displacement", inner_displacement_});
  views.push_back({"element_unbalanced", n_unbalanced_});
  views.push_back({"element_unbalanced_force", unbalanced_force_});
  views.push_back({"element_unbalanced_work", unbalanced_work_});
  views.push_back({"element_start_energy", start_energy_});
  return views;
}

template <class Law>
void SmallStrainEnhanced<Law>::lumped_mass(const std::size_t element, double *mass) const
{
  for (int node = 0; node < n_nodes; ++node)
  {
    mass[node] = 0;
    for (int point = 0; point < points_per_pack; ++point)
      mass[node] += this->law().density() * hexahedron::shape_value(node, point) * geometry_[element].volume[point];
  }
}

template <class Law>
void SmallStrainEnhanced<Law>::stiffness(const std::size_t element, const double *, double *matrix) const
{
  double all[n_all_dofs * n_all_dofs];
  enhanced::stiffness(
      geometry_[element],
      [&](const Points(&unit_strain)[6], Points(&stress)[6]) { elastic_stress(this->law(), unit_strain, stress); },
      all);
  enhanced::condense(all, matrix);
  const double factor = this->stiffness_factor(element);
  for (int entry = 0; entry < n_dofs * n_dofs; ++entry)
    matrix[entry] *= factor;
}

template <class Law>
void SmallStrainEnhanced<Law>::tangent(const std::size_t element, const double *displacement, const double *before,
                                       double *matrix) const
{
  double increment[n_dofs], all[n_all_dofs * n_all_dofs];
  this->gather_increment(element, displacement, before, increment);
  Points moduli[6][6];
  this->tangent_moduli(element, 0, find_step(element, increment).strain, moduli);
  enhanced::stiffness(
      geometry_[element],
      [&](const Points(&unit_strain)[6], Points(&stress)[6]) { apply_moduli(moduli, unit_strain, stress); }, all);
  enhanced::condense(all, matrix);
}

template <class Law>
void SmallStrainEnhanced<Law>::set_share(std::span<const double>)
{
  throw ConfigError("continuum: a two-scale model shares no elements of enhanced strains; choose those without");
}

template class SmallStrainEnhanced<LinearElastic>;
template class SmallStrainEnhanced<MohrCoulomb>;

} // namespace bergamo::fe
