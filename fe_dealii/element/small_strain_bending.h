#pragma once

#include "fe_dealii/element/bending_elements.h"
#include "fe_dealii/element/small_strain_elements.h"
#include "fe_dealii/element/start_force.h"

namespace bergamo::fe
{

/// Hexahedra of 8 nodes that bend at small strain, see bending_hexahedron.h: one point an element, at its mean strain,
/// and hourglass forces that are elastic and fade where the mean flows, see hourglass_flow.h. So what bends within one
/// element alone, with no mean strain, never flows. Stresses at the start count point by point: what they do beyond
/// their mean is a constant force.
template <class Law>
class SmallStrainBending final : public SmallStrainElements<Law>
{
public:
  using History = typename SmallStrainElements<Law>::History;

  /// @param corners one an element; @param start of the eight points of each element, see SmallStrainElements
  SmallStrainBending(const Law &law, std::vector<unsigned int> nodes, std::vector<bending::Corners> corners,
                     const std::vector<History> &start);

  std::optional<std::size_t> compute_forces(std::size_t begin, std::size_t end, const double *displacement,
                                            const double *before) override;
  void lumped_mass(std::size_t element, double *mass) const override;
  void stiffness(std::size_t element, const double *displacement, double *matrix) const override;
  void tangent(std::size_t element, const double *displacement, const double *before, double *matrix) const override;
  bool has_symmetric_tangent() const override;
  void set_share(std::span<const double> nodal_share) override;
  ElementState state_of(std::size_t element, const double *displacement) const override;
  double elastic_energy() const override;
  std::vector<std::pair<std::string, std::span<double>>> state() override;

  /// Stored by the hourglass modes of an element, share included [J].
  double hourglass_energy(std::size_t element) const;

private:
  using Amplitudes = Points[bending::n_modes][3];
  struct Modes // of the eight elements of a pack
  {
    Amplitudes elastic; // whose forces are those of the modes at the law's moduli at no strain [m]
  };

  double point_volume(const std::size_t element, int) const override { return elements_.volume(element); }
  double point_share_volume(const std::size_t element, int) const override
  {
    return elements_.pack(element / points_per_pack).volume[element % points_per_pack];
  }

  /// Lets the amplitudes follow, and books what they lose. @param before the step
  /// @param force of the modes after it [N]
  void move_hourglass(std::size_t pack, const History &before, const Points (&strain)[6], const Amplitudes &increment,
                      Amplitudes &force);
  /// Where an element is rigid, all is as before the step.
  void keep_rigid(std::size_t pack, const History &before, const Modes &modes_before);
  Points softness(const History &history) const; // of the law's moduli in the present stresses
  void find_start_force();

  bending::Elements elements_;
  std::vector<Modes> hourglass_;
  std::vector<std::array<Stress, bending::n_points>> start_stress_; // of each element, at its points
  StartForce start_force_;                                          // none where stresses are even in each element
};

extern template class SmallStrainBending<LinearElastic>;
extern template class SmallStrainBending<MohrCoulomb>;
extern template class SmallStrainBending<HypoplasticSand>;

} // namespace bergamo::fe
