#pragma once

#include "fe_dealii/element/element_group.h"
#include "fe_dealii/element/stress_update.h"

#include <type_traits>

namespace bergamo::fe
{

/// What elements of small strain share, whatever their shape: the law, the points' histories and what follows from
/// them.
/// @tparam Law LinearElastic, MohrCoulomb or HypoplasticSand
template <class Law>
class SmallStrainElements : public ElementGroup
{
public:
  using History = typename KeptAtPoints<Law>::History;
  using Report = typename KeptAtPoints<Law>::Report;

  ElementState state_of(std::size_t element, const double *displacement) const override;
  double elastic_energy() const override;
  double dissipated_energy() const final;
  double stiffness_loss() const final;
  double stiffness_factor(std::size_t element) const final;
  std::vector<std::pair<std::string, std::span<double>>> state() override;
  double volume(std::size_t element) const final;
  std::string failure(std::size_t element) const override;
  bool has_symmetric_tangent() const override;

  const Law &law() const { return law_; }
  Stress stress(std::size_t element, int point) const;
  /// Of the last increment.
  Sector sector(const std::size_t element, const int point) const requires std::is_same_v<Report, Sector>
  {
    return report_[n_lanes_ * element + point];
  }
  /// Where each element has packs of its own.
  const History &point_history(const std::size_t element, const int pack) const
  {
    return history_[n_lanes_ / points_per_pack * element + pack];
  }

protected:
  /// @param start of the points: initial stresses, the rest zero; in packs, one element after the other
  /// @param lanes_per_element points of an element, those without a volume included: whole packs, or 1
  SmallStrainElements(const Law &law, int nodes_per_element, std::vector<unsigned int> nodes,
                      std::vector<History> start, int lanes_per_element);

  /// Moduli of the law at a point, for a strain increment from the present stresses.
  Moduli tangent_moduli(std::size_t element, int point, const Strain &strain_increment) const;
  /// The same at the points of a pack.
  void tangent_moduli(std::size_t element, int pack, const Points (&strain_increment)[6], Points (&moduli)[6][6]) const;

  virtual double point_volume(std::size_t element, int point) const = 0;       ///< weight times Jacobian [m³]
  virtual double point_share_volume(std::size_t element, int point) const = 0; ///< times the continuum's share

  History &history(const std::size_t pack) { return history_[pack]; }
  const History &history(const std::size_t pack) const { return history_[pack]; }
  Report *reports(const std::size_t pack) { return &report_[points_per_pack * pack]; }

private:
  double stored_energy(std::size_t element, int point) const; // of the point's stress [J/m³]
  const History &history_of(const std::size_t element, const int point) const
  {
    return history_[(n_lanes_ * element + point) / points_per_pack];
  }
  int lane_of(const std::size_t element, const int point) const
  {
    return (n_lanes_ * element + point) % points_per_pack;
  }

  Law law_;
  int n_lanes_; // of an element
  std::vector<History> history_;
  std::vector<Report> report_;
};

extern template class SmallStrainElements<LinearElastic>;
extern template class SmallStrainElements<MohrCoulomb>;
extern template class SmallStrainElements<HypoplasticSand>;

} // namespace bergamo::fe
