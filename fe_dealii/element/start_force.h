#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace bergamo::fe
{

/// Constant nodal forces of elements that stand for stresses at the start beside those that the elements themselves
/// make of them, and their potential: force times displacement.
class StartForce
{
public:
  StartForce() = default;
  /// @param force of all elements, one after the other [N]
  StartForce(std::vector<double> force, const int dofs_per_element)
      : n_dofs(dofs_per_element), force_(std::move(force)), energy_(force_.size() / n_dofs, 0.)
  {
  }

  bool is_empty() const { return force_.empty(); }

  /// @param displacement of the element [m]; @param force to which that at the start is added [N]
  void add(const std::size_t element, const double *displacement, double *force)
  {
    const double *const start = &force_[n_dofs * element];
    double energy = 0;
    for (int dof = 0; dof < n_dofs; ++dof)
    {
      force[dof] += start[dof];
      energy += start[dof] * displacement[dof];
    }
    energy_[element] = energy;
  }

  std::span<double> energy() { return energy_; } ///< of each element at its last add() [J]
  std::span<const double> energy() const { return energy_; }

private:
  int n_dofs = 1;
  std::vector<double> force_, energy_;
};

} // namespace bergamo::fe
