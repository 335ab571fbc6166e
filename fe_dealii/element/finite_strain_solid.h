#pragma once

#include "fe_dealii/element/element_group.h"
#include "fe_dealii/element/finite_strain.h"
#include "fe_dealii/material/mooney_rivlin.h"
#include "fe_dealii/material/neo_hooke.h"
#include "fe_dealii/material/ogden.h"

namespace bergamo::fe
{

/// Hexahedra of 8 or 27 nodes at large strain, see finite_strain.h. Those of 8 nodes take the dilatation at its mean;
/// those of 27 do not lock and take it at the points.
/// @tparam Law NeoHooke, MooneyRivlin or Ogden
template <class Law, int n_nodes>
class FiniteStrainSolid final : public ElementGroup
{
public:
  static constexpr int n_packs = packs_of(n_nodes);
  static constexpr finite_strain::Dilatation dilatation =
      n_nodes == 8 ? finite_strain::Dilatation::mean : finite_strain::Dilatation::point;
  using Geometry = SolidGeometry<n_nodes, n_packs>;

  /// @param mass_shares of each node in its element; as many as nodes
  FiniteStrainSolid(const Law &law, std::vector<unsigned int> nodes, std::vector<Geometry> geometry,
                    MassShares mass_shares);

  std::optional<std::size_t> compute_forces(std::size_t begin, std::size_t end, const double *displacement,
                                            const double *before) override;
  void lumped_mass(std::size_t element, double *mass) const override;
  void gravitational_mass(std::size_t element, double *mass) const override;
  void stiffness(std::size_t element, const double *displacement, double *matrix) const override;
  bool stiffens_with_displacement() const override { return true; }
  void tangent(const std::size_t element, const double *displacement, const double *, double *matrix) const override
  {
    stiffness(element, displacement, matrix);
  }
  void set_share(std::span<const double> nodal_share) override;
  bool bends() const override { return n_nodes != 8; }
  double volume(const std::size_t element) const override { return geometry_[element].whole_volume(); }
  ElementState state_of(std::size_t element, const double *displacement) const override;
  double elastic_energy() const override;
  double dissipated_energy() const override { return 0; }
  std::vector<std::pair<std::string, std::span<double>>> state() override { return {{"element_energy", energy_}}; }

private:
  Law law_;
  std::vector<Geometry> geometry_;
  MassShares mass_shares_;
  std::vector<double> energy_; // of each element at the last compute_forces()
};

extern template class FiniteStrainSolid<NeoHooke, 8>;
extern template class FiniteStrainSolid<NeoHooke, 27>;
extern template class FiniteStrainSolid<MooneyRivlin, 8>;
extern template class FiniteStrainSolid<MooneyRivlin, 27>;
extern template class FiniteStrainSolid<Ogden, 8>;
extern template class FiniteStrainSolid<Ogden, 27>;

} // namespace bergamo::fe
