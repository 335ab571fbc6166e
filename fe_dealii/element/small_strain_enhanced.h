#pragma once

#include "fe_dealii/element/enhanced_hexahedron.h"
#include "fe_dealii/element/small_strain_elements.h"

namespace bergamo::fe
{

/// Hexahedra of 8 nodes with enhanced strains, small strain: see enhanced_hexahedron.h. In every step each element
/// finds the displacements of its modes by itself, by Broyden's method from the elastic stiffness: elastic elements
/// need one step of it, flowing ones some more. Stresses at the start count point by point, see
/// enhanced::start_force().
template <class Law>
class SmallStrainEnhanced final : public SmallStrainElements<Law>
{
public:
  /// Share of the stresses that may be out of balance on the modes, in the norm of the elastic energy.
  static constexpr double tolerance = 1e-12;

  /// @param start see SmallStrainElements
  SmallStrainEnhanced(const Law &law, std::vector<unsigned int> nodes, std::vector<enhanced::Geometry> geometry,
                      std::vector<PointHistory> start);

  std::optional<std::size_t> compute_forces(std::size_t begin, std::size_t end, const double *displacement,
                                            const double *before) override;
  void lumped_mass(std::size_t element, double *mass) const override;
  void stiffness(std::size_t element, const double *displacement, double *matrix) const override;
  void tangent(std::size_t element, const double *displacement, const double *before, double *matrix) const override;
  void set_share(std::span<const double> nodal_share) override;
  double elastic_energy() const override;
  double stiffness_loss() const override; ///< with the work of stresses that found no balance on the modes
  std::vector<std::pair<std::string, std::span<double>>> state() override;

  const enhanced::Geometry &geometry(const std::size_t element) const { return geometry_[element]; }
  /// Displacements of the modes since the start, 3*mode + component [m].
  std::span<const double> inner_displacement(const std::size_t element) const
  {
    return {&inner_displacement_[enhanced::n_inner_dofs * element], enhanced::n_inner_dofs};
  }
  /// Forces on the modes at the last stresses, zero but for the tolerance [N].
  std::array<double, enhanced::n_inner_dofs> inner_force(std::size_t element) const;
  /// How often an element has gone on with stresses out of balance on its modes since the start: never where the law is
  /// elastic, seldom else. Their work is booked, and the next step looks for the balance again.
  std::size_t n_unbalanced() const;

private:
  struct Step; // what a strain increment gives

  const Points &pack_volume(const std::size_t element, int) const override { return geometry_[element].volume; }
  const Points &pack_share_volume(const std::size_t element, int) const override { return geometry_[element].volume; }

  /// Carries the stresses of an element over displacement increments of its nodes.
  Step find_step(std::size_t element, const double *increment) const;
  void book_unbalanced(std::size_t element, const Step &step);
  void find_start_force();
  void find_inverses();
  double start_force(const std::size_t element, const int dof) const
  {
    return start_force_.empty() ? 0 : start_force_[enhanced::n_all_dofs * element + dof];
  }
  void add_start_force(std::size_t element, const double *displacement);

  std::vector<enhanced::Geometry> geometry_;
  std::vector<std::array<double, enhanced::n_inner_dofs * enhanced::n_inner_dofs>> inverse_; // of the modes' stiffness
  std::vector<double> inner_displacement_;
  std::vector<double> n_unbalanced_; // of each element; doubles, as they are part of the state
  std::vector<double> unbalanced_force_, unbalanced_work_;
  std::vector<double> start_force_;  // enhanced::start_force(), none where the stresses at the start are uniform
  std::vector<double> start_energy_; // of each element, its potential: start force times displacement [J]
};

extern template class SmallStrainEnhanced<LinearElastic>;
extern template class SmallStrainEnhanced<MohrCoulomb>;

} // namespace bergamo::fe
