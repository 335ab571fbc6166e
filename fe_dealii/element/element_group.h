#pragma once

#include "fe_dealii/material/tensor.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace bergamo::fe
{

/// An element's mean state, for output.
struct ElementState
{
  Stress stress{};           ///< Cauchy, mean over the volume [Pa]
  double volume = 0;         ///< of which: present at large strain, in the reference configuration at small [m³]
  double yield_function = 0; ///< of the mean stress [Pa]; 0 without a yield surface
  double plastic_strain = 0; ///< mean of the accumulated equivalent strain [-]
  double energy_density = 0; ///< elastic_energy() over the reference volume, whatever the share [J/m³]
  double void_ratio = 0;     ///< mean [-]; 0 where the law has none
};

/// Elements of one shape and one law: strains to stresses to nodal forces. Calls are virtual by blocks of elements.
/// Displacements are arrays of the whole body, 3*node + component [m].
class ElementGroup
{
public:
  /// @param nodes of the elements one after the other
  ElementGroup(int nodes_per_element, std::vector<unsigned int> nodes)
      : n_element_nodes(nodes_per_element), node(std::move(nodes)), force_of_dof(3 * node.size())
  {
  }
  virtual ~ElementGroup() = default;

  int nodes_per_element() const { return n_element_nodes; }
  int dofs_per_element() const { return 3 * n_element_nodes; }
  std::size_t size() const { return node.size() / n_element_nodes; }
  std::span<const unsigned int> nodes(const std::size_t element) const
  {
    return {&node[element * n_element_nodes], std::size_t(n_element_nodes)};
  }
  std::span<const unsigned int> nodes() const { return node; }

  /// Whether an element moves as a rigid body: it has no forces then, its stress and energy stay, and it sets no stable
  /// step. Elements of small strain would resist a rotation.
  bool is_rigid(const std::size_t element) const { return !rigid.empty() && rigid[element] != 0; }
  virtual void make_rigid(const std::size_t element)
  {
    rigid.resize(size(), 0);
    rigid[element] = 1;
    std::fill_n(force(element), dofs_per_element(), 0.);
  }

  /// Nodal forces of the elements as last computed, in the order of nodes(), three each [N].
  std::span<const double> forces() const { return force_of_dof; }

  /// Places in the order in which forces are computed; more than there are elements where some stay empty.
  virtual std::size_t n_places() const { return size(); }
  /// Computes the forces of the elements at the places from begin, a multiple of eight, to end. Blocks may run at the
  /// same time.
  /// @param before displacement at the last call
  /// @return the first element that cannot go on, see failure()
  virtual std::optional<std::size_t> compute_forces(std::size_t begin, std::size_t end, const double *displacement,
                                                    const double *before) = 0;

  /// What an element is in that compute_forces() has named, and the remedy: the rest of a sentence "element E has".
  virtual std::string failure(std::size_t) const
  {
    return "collapsed or turned inside out; choose a smaller time step, a finer mesh there or a smaller load";
  }

  /// Lumped mass at the nodes of an element, all positive [kg].
  virtual void lumped_mass(std::size_t element, double *mass) const = 0;

  /// What a body force acts on at the nodes of an element, ∫ N ρ dV with the share [kg]: work-conjugate to the
  /// displacements on any mesh. The row sum of the consistent mass, which may be negative at nodes of a distorted
  /// quadratic element; where the lumped mass is that sum, the same.
  virtual void gravitational_mass(const std::size_t element, double *mass) const { lumped_mass(element, mass); }

  /// Elastic stiffness at a displacement, row-major [N/m]; of the stiffest point where it depends on the pressure. At
  /// large strain the tangent, with the part of the present stresses.
  virtual void stiffness(std::size_t element, const double *displacement, double *matrix) const = 0;

  /// Factor of the law's moduli that stiffness() takes in the present stresses; 1 where they do not depend on them. Not
  /// finite where these are not.
  virtual double stiffness_factor(std::size_t) const { return 1; }
  /// Whether stiffness() depends on the displacement.
  virtual bool stiffens_with_displacement() const { return false; }

  /// Derivative by the displacement of the forces that compute_forces(displacement, before) would give, row-major
  /// [N/m].
  virtual void tangent(std::size_t element, const double *displacement, const double *before, double *matrix) const = 0;
  /// Whether tangent() always is; not where the flow is not associated.
  virtual bool has_symmetric_tangent() const { return true; }

  /// Share of the body in what a two-scale model weighs, at the nodes of the whole body, in [0, 1]: multiplies mass and
  /// forces. Throws ConfigError where the elements know no shares.
  virtual void set_share(std::span<const double> nodal_share) = 0;

  /// Whether one element over a thickness bends as it should; those of 8 nodes with strains at their points do not.
  virtual bool bends() const { return true; }

  virtual double volume(std::size_t element) const = 0; ///< in the reference configuration, whatever the share [m³]
  virtual ElementState state_of(std::size_t element, const double *displacement) const = 0;
  virtual double elastic_energy() const = 0; ///< at the last compute_forces() [J]
  /// By plastic flow since the start; all work of the stresses where a law stores no energy [J].
  virtual double dissipated_energy() const = 0;
  /// Elastic work since the start less the energy that it has stored, where the stiffness depends on the pressure [J].
  virtual double stiffness_loss() const { return 0; }

  /// What changes from step to step and a restart needs, as views.
  virtual std::vector<std::pair<std::string, std::span<double>>> state() = 0;

protected:
  double *force(const std::size_t element) { return &force_of_dof[dofs_per_element() * element]; }

  /// The dofs of an element, gathered from those of the body.
  void gather(const std::size_t element, const double *of_body, double *of_element) const
  {
    const unsigned int *const first = &node[element * n_element_nodes];
    for (int k = 0; k < n_element_nodes; ++k)
      for (int i = 0; i < 3; ++i)
        of_element[3 * k + i] = of_body[3 * std::size_t(first[k]) + i];
  }

  void gather_increment(const std::size_t element, const double *now, const double *before, double *increment) const
  {
    const unsigned int *const first = &node[element * n_element_nodes];
    for (int k = 0; k < n_element_nodes; ++k)
      for (int i = 0; i < 3; ++i)
        increment[3 * k + i] = now[3 * std::size_t(first[k]) + i] - before[3 * std::size_t(first[k]) + i];
  }

private:
  int n_element_nodes;
  std::vector<unsigned int> node;
  std::vector<double> force_of_dof;
  std::vector<char> rigid; // none where no element is
};

} // namespace bergamo::fe
