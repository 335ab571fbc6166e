#pragma once

#include "fe_dealii/element/element_group.h"
#include "fe_dealii/element/hexahedron.h"

#include <type_traits>

namespace bergamo::fe
{

/// Trilinear hexahedra with a mean dilatation at small strain, see hexahedron.h.
/// @tparam Law LinearElastic or MohrCoulomb
template <class Law>
class SmallStrainHexahedra final : public ElementGroup
{
public:
  /// @param initial_pressure of the uniform initial stress −p0 I [Pa]
  SmallStrainHexahedra(const Law &law, std::vector<unsigned int> nodes, std::vector<hexahedron::Geometry> geometry,
                       double initial_pressure);

  std::optional<std::size_t> compute_forces(std::size_t begin, std::size_t end, const double *displacement,
                                            const double *before) override;
  void lumped_mass(std::size_t element, double *mass) const override;
  void stiffness(std::size_t element, const double *displacement, double *matrix) const override;
  void set_share(std::span<const double> nodal_share) override;
  double volume(std::size_t element) const override { return sum(geometry_[element].volume); }
  ElementState state_of(std::size_t element, const double *displacement) const override;
  double elastic_energy() const override;
  double dissipated_energy() const override;
  std::vector<std::pair<std::string, std::span<double>>> state() override;

  const Law &law() const { return law_; }
  const hexahedron::Geometry &geometry(const std::size_t element) const { return geometry_[element]; }
  Stress stress(std::size_t element, int point) const;
  Sector sector(const std::size_t element, const int point) const
  {
    return sector_[hexahedron::n_points * element + point];
  }

private:
  Law law_;
  std::vector<hexahedron::Geometry> geometry_;
  std::vector<hexahedron::History> history_;
  std::vector<Sector> sector_;
};

extern template class SmallStrainHexahedra<LinearElastic>;
extern template class SmallStrainHexahedra<MohrCoulomb>;

} // namespace bergamo::fe
