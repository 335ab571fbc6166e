#pragma once

#include "fe_dealii/element/bending_elements.h"
#include "fe_dealii/element/element_group.h"
#include "fe_dealii/material/mooney_rivlin.h"
#include "fe_dealii/material/neo_hooke.h"
#include "fe_dealii/material/ogden.h"

namespace bergamo::fe
{

/// Hexahedra of 8 nodes that bend at large strain, see bending_hexahedron.h. Their energy is V (W + U)(F̄) + ½ q·K q
/// with the amplitudes q_α = F̄ᵀ h_α, drawn back to the reference frame. So at small strain it is the element with
/// enhanced strains to the last digit; a rotation changes nothing; and K stays positive whatever the deformation, where
/// enhanced strains with the law at each point lose their stiffness against hourglasses under large compression
/// (Wriggers and Reese, Comput. Methods Appl. Mech. Eng. 135 (1996) 201–209). The price: where strains differ much
/// within an element, this difference is taken as linear.
/// @tparam Law NeoHooke, MooneyRivlin or Ogden
template <class Law>
class FiniteStrainBending final : public ElementGroup
{
public:
  /// @param corners one an element
  FiniteStrainBending(const Law &law, std::vector<unsigned int> nodes, std::vector<bending::Corners> corners);

  std::optional<std::size_t> compute_forces(std::size_t begin, std::size_t end, const double *displacement,
                                            const double *before) override;
  void lumped_mass(std::size_t element, double *mass) const override;
  void stiffness(std::size_t element, const double *displacement, double *matrix) const override;
  bool stiffens_with_displacement() const override { return true; }
  void tangent(const std::size_t element, const double *displacement, const double *, double *matrix) const override
  {
    stiffness(element, displacement, matrix);
  }
  void set_share(std::span<const double> nodal_share) override;
  double volume(const std::size_t element) const override { return elements_.volume(element); }
  /// The stress is that of the mean deformation.
  ElementState state_of(std::size_t element, const double *displacement) const override;
  double elastic_energy() const override;
  double dissipated_energy() const override { return 0; }
  std::vector<std::pair<std::string, std::span<double>>> state() override { return {{"element_energy", energy_}}; }

private:
  Law law_;
  bending::Elements elements_;
  std::vector<Points> place_;  // of the nodes in the reference, by pack [m]
  std::vector<double> energy_; // of each element at the last compute_forces()
};

extern template class FiniteStrainBending<NeoHooke>;
extern template class FiniteStrainBending<MooneyRivlin>;
extern template class FiniteStrainBending<Ogden>;

} // namespace bergamo::fe
