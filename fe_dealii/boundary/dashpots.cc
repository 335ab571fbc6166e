#include "fe_dealii/boundary/dashpots.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include <algorithm>

namespace bergamo::fe
{
namespace
{

Eigen::Matrix3d matrix_of(const std::array<double, 6> &c)
{
  return Eigen::Matrix3d{{c[0], c[3], c[5]}, {c[3], c[1], c[4]}, {c[5], c[4], c[2]}};
}

} // namespace

void Dashpots::add(const std::span<const Dashpot> dashpots, const std::size_t n_nodes)
{
  place_.resize(n_nodes, -1);
  for (const Dashpot &dashpot : dashpots)
  {
    dashpots_.push_back(dashpot);
    place_[dashpot.node] = 0;
  }
  nodes_.clear();
  for (unsigned int node = 0; node < n_nodes; ++node)
    if (place_[node] >= 0)
    {
      place_[node] = static_cast<int>(nodes_.size());
      nodes_.push_back(node);
    }
  elements_.clear();
  for (const Dashpot &dashpot : dashpots_)
    elements_.push_back(dashpot.element);
  std::sort(elements_.begin(), elements_.end());
  elements_.erase(std::unique(elements_.begin(), elements_.end()), elements_.end());
  element_place_.clear();
  for (const Dashpot &dashpot : dashpots_)
    element_place_.push_back(std::lower_bound(elements_.begin(), elements_.end(), dashpot.element) - elements_.begin());
  set_viscosity(std::vector<double>(elements_.size(), 1.));
}

void Dashpots::set_viscosity(const std::span<const double> factor)
{
  viscosity_.assign(nodes_.size(), {});
  for (std::size_t k = 0; k < dashpots_.size(); ++k)
    for (int i = 0; i < 6; ++i)
      viscosity_[place_[dashpots_[k].node]][i] += factor[element_place_[k]] * dashpots_[k].viscosity[i];
}

Dashpots::Vector Dashpots::drag(const std::size_t node, const Vector &velocity) const
{
  const Eigen::Vector3d force =
      matrix_of(viscosity_[place_[node]]) * Eigen::Vector3d(velocity[0], velocity[1], velocity[2]);
  return {force[0], force[1], force[2]};
}

Dashpots::Vector Dashpots::velocity_after(const std::size_t node, const Kick &kick) const
{
  // With J = inertia and v⁺ = w + x: (J + C/2) x = −C (v⁻ + w)/2, and x = 0 where it is prescribed.
  const Eigen::Matrix3d viscosity = matrix_of(viscosity_[place_[node]]);
  Eigen::Vector3d mean;
  for (int i = 0; i < 3; ++i)
    mean[i] = 0.5 * (kick.old[i] + kick.without[i]);
  Eigen::Vector3d right = -viscosity * mean;
  Eigen::Matrix3d left = 0.5 * viscosity;
  for (int i = 0; i < 3; ++i)
  {
    if (!kick.is_free[i])
    {
      left.row(i).setZero();
      left.col(i).setZero();
      right[i] = 0;
    }
    left(i, i) += kick.inertia[i];
  }
  const Eigen::Vector3d change = left.llt().solve(right);
  return {kick.without[0] + change[0], kick.without[1] + change[1], kick.without[2] + change[2]};
}

} // namespace bergamo::fe
