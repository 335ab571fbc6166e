#pragma once

#include "fe_dealii/element/element_group.h"
#include "fe_dealii/element/stress_update.h"

namespace bergamo::fe
{

/// What elements of small strain share, whatever their shape: the law, the points' histories and what follows from
/// them.
/// @tparam Law LinearElastic or MohrCoulomb
template <class Law>
class SmallStrainElements : public ElementGroup
{
public:
  ElementState state_of(std::size_t element, const double *displacement) const final;
  double elastic_energy() const override;
  double dissipated_energy() const final;
  double stiffness_loss() const override;
  double stiffness_factor(std::size_t element) const final;
  std::vector<std::pair<std::string, std::span<double>>> state() override;
  double volume(std::size_t element) const final;

  const Law &law() const { return law_; }
  Stress stress(std::size_t element, int point) const;
  Sector sector(const std::size_t element, const int point) const
  {
    return sector_[points_per_pack * n_packs_ * element + point];
  }

protected:
  /// @param start of the points: initial stresses, the rest zero; as many as packs of the elements, one element after
  /// the other
  SmallStrainElements(const Law &law, int nodes_per_element, std::vector<unsigned int> nodes,
                      std::vector<PointHistory> start);

  /// Moduli of the law at the points of a pack, for a strain increment from the present stresses.
  void tangent_moduli(std::size_t element, int pack, const Points (&strain_increment)[6], Points (&moduli)[6][6]) const;

  virtual const Points &pack_volume(std::size_t element, int pack) const = 0;       ///< weight times Jacobian [m³]
  virtual const Points &pack_share_volume(std::size_t element, int pack) const = 0; ///< times the continuum's share

  PointHistory &history(const std::size_t element, const int pack) { return history_[n_packs_ * element + pack]; }
  const PointHistory &history(const std::size_t element, const int pack) const
  {
    return history_[n_packs_ * element + pack];
  }
  Sector *sectors(const std::size_t element, const int pack)
  {
    return &sector_[points_per_pack * (n_packs_ * element + pack)];
  }

private:
  double stored_energy(std::size_t element, int point) const; // of the point's stress [J/m³]

  Law law_;
  int n_packs_;
  std::vector<PointHistory> history_;
  std::vector<Sector> sector_;
};

extern template class SmallStrainElements<LinearElastic>;
extern template class SmallStrainElements<MohrCoulomb>;

} // namespace bergamo::fe
