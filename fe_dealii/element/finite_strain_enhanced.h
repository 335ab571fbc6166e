#pragma once

#include "fe_dealii/element/element_group.h"
#include "fe_dealii/element/stabilized_hexahedron.h"
#include "fe_dealii/material/mooney_rivlin.h"
#include "fe_dealii/material/neo_hooke.h"
#include "fe_dealii/material/ogden.h"

namespace bergamo::fe
{

/// Hexahedra of 8 nodes at large strain whose hourglass modes have the stiffness of enhanced strains, see
/// stabilized_hexahedron.h.
/// @tparam Law NeoHooke, MooneyRivlin or Ogden
template <class Law>
class FiniteStrainEnhanced final : public ElementGroup
{
public:
  /// @param node_volume ∫ N dV of each node in its element, as many as nodes [m³]
  FiniteStrainEnhanced(const Law &law, std::vector<unsigned int> nodes, std::vector<stabilized::Geometry> geometry,
                       std::vector<double> node_volume);

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
  double volume(const std::size_t element) const override { return geometry_[element].volume; }
  /// The stress is that of the mean deformation.
  ElementState state_of(std::size_t element, const double *displacement) const override;
  double elastic_energy() const override;
  double dissipated_energy() const override { return 0; }
  std::vector<std::pair<std::string, std::span<double>>> state() override { return {{"element_energy", energy_}}; }

private:
  Law law_;
  std::vector<stabilized::Geometry> geometry_;
  std::vector<double> node_volume_;
  std::vector<double> energy_; // of each element at the last compute_forces()
};

extern template class FiniteStrainEnhanced<NeoHooke>;
extern template class FiniteStrainEnhanced<MooneyRivlin>;
extern template class FiniteStrainEnhanced<Ogden>;

} // namespace bergamo::fe
