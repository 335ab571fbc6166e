#pragma once

#include "fe_dealii/element/small_strain_elements.h"
#include "fe_dealii/element/solid_geometry.h"

namespace bergamo::fe
{

/// Triquadratic hexahedra of 27 nodes at small strain, integrated in full at 27 points: their quadratic displacements
/// bend and keep the volume without locking, at the price of four packs of points.
template <class Law>
class SmallStrainQuadratic final : public SmallStrainElements<Law>
{
public:
  static constexpr int n_nodes = 27, n_packs = packs_of(n_nodes);
  using Geometry = SolidGeometry<n_nodes, n_packs>;

  /// @param mass_shares of each node in its element; as many as nodes; @param start see SmallStrainElements
  SmallStrainQuadratic(const Law &law, std::vector<unsigned int> nodes, std::vector<Geometry> geometry,
                       MassShares mass_shares, std::vector<typename SmallStrainElements<Law>::History> start);

  std::optional<std::size_t> compute_forces(std::size_t begin, std::size_t end, const double *displacement,
                                            const double *before) override;
  void lumped_mass(std::size_t element, double *mass) const override;
  void gravitational_mass(std::size_t element, double *mass) const override;
  void stiffness(std::size_t element, const double *displacement, double *matrix) const override;
  void tangent(std::size_t element, const double *displacement, const double *before, double *matrix) const override;
  void set_share(std::span<const double> nodal_share) override;

private:
  double point_volume(const std::size_t element, const int point) const override
  {
    return geometry_[element].volume[point / points_per_pack][point % points_per_pack];
  }
  double point_share_volume(const std::size_t element, const int point) const override
  {
    return point_volume(element, point);
  }

  std::vector<Geometry> geometry_;
  MassShares mass_shares_;
};

extern template class SmallStrainQuadratic<LinearElastic>;
extern template class SmallStrainQuadratic<MohrCoulomb>;
extern template class SmallStrainQuadratic<HypoplasticSand>;

} // namespace bergamo::fe
