#include "fe_dealii/element/small_strain_elements.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace bergamo::fe
{

template <class Law>
SmallStrainElements<Law>::SmallStrainElements(const Law &law, const int nodes_per_element,
                                              std::vector<unsigned int> nodes, std::vector<History> start)
    : ElementGroup(nodes_per_element, std::move(nodes)), law_(law), n_packs_(start.size() / size()),
      history_(std::move(start)), report_(points_per_pack * history_.size(), Report{})
{
}

template <class Law>
double SmallStrainElements<Law>::volume(const std::size_t element) const
{
  double result = 0;
  for (int pack = 0; pack < n_packs_; ++pack)
    result += sum(pack_volume(element, pack));
  return result;
}

template <class Law>
Stress SmallStrainElements<Law>::stress(const std::size_t element, const int point) const
{
  const History &pack = history_[n_packs_ * element + point / points_per_pack];
  Stress result;
  for (int i = 0; i < 6; ++i)
    result[i] = pack.stress[i][point % points_per_pack];
  return result;
}

template <class Law>
ElementState SmallStrainElements<Law>::state_of(const std::size_t element, const double *) const
{
  ElementState state;
  const double whole = volume(element);
  for (int pack = 0; pack < n_packs_; ++pack)
  {
    const History &history = history_[n_packs_ * element + pack];
    const Points fraction = pack_volume(element, pack) / whole;
    for (int i = 0; i < 6; ++i)
      state.stress[i] += sum(fraction * history.stress[i]);
    state.plastic_strain += sum(fraction * history.plastic_strain);
    if constexpr (std::is_same_v<Law, HypoplasticSand>)
      state.void_ratio += sum(fraction * history.void_ratio);
  }
  for (int point = 0; point < points_per_pack * n_packs_; ++point)
    state.energy_density +=
        pack_volume(element, point / points_per_pack)[point % points_per_pack] / whole * stored_energy(element, point);
  if constexpr (std::is_same_v<Law, MohrCoulomb>)
    state.yield_function = law_.yield_function(state.stress);
  return state;
}

template <class Law>
double SmallStrainElements<Law>::stored_energy(const std::size_t element, const int point) const
{
  const Stress at_point = stress(element, point);
  if constexpr (std::is_same_v<Law, MohrCoulomb>)
    return law_.elastic_energy_density(mean_stress(at_point), second_invariant(at_point));
  else if constexpr (std::is_same_v<Law, HypoplasticSand>)
    return 0;
  else
    return elastic_energy_density(at_point, law_.bulk_modulus(), law_.shear_modulus());
}

template <class Law>
double SmallStrainElements<Law>::elastic_energy() const
{
  double energy = 0;
  for (std::size_t e = 0; e < size(); ++e)
    for (int point = 0; point < points_per_pack * n_packs_; ++point)
      energy += pack_share_volume(e, point / points_per_pack)[point % points_per_pack] * stored_energy(e, point);
  return energy;
}

template <class Law>
double SmallStrainElements<Law>::stiffness_loss() const
{
  double energy = 0;
  for (const History &history : history_)
    energy += sum(history.stiffness_loss);
  return energy;
}

template <class Law>
double SmallStrainElements<Law>::dissipated_energy() const
{
  double energy = 0;
  for (const History &history : history_)
    energy += sum(history.dissipated_energy);
  return energy;
}

template <class Law>
double SmallStrainElements<Law>::stiffness_factor(const std::size_t element) const
{
  if constexpr (std::is_same_v<Law, MohrCoulomb>)
    if (law_.depends_on_pressure())
    {
      double least_trace = HUGE_VAL, checked = 0;
      for (int pack = 0; pack < n_packs_; ++pack)
      {
        const Points(&stress)[6] = history_[n_packs_ * element + pack].stress;
        const Points trace = stress[0] + stress[1] + stress[2];
        least_trace = std::min(least_trace, math::least(trace));
        checked += sum(trace);
      }
      return std::isfinite(checked) ? law_.stiffness_factor(least_trace / 3) : checked;
    }
  if constexpr (std::is_same_v<Law, HypoplasticSand>)
  {
    double greatest = 0, checked = 0;
    for (int point = 0; point < points_per_pack * n_packs_; ++point)
    {
      const double factor =
          law_.stiffness_factor(sand_state(point_history(element, point / points_per_pack), point % points_per_pack));
      greatest = std::max(greatest, factor);
      checked += factor;
    }
    return std::isfinite(checked) ? greatest : checked;
  }
  return 1;
}

template <class Law>
void SmallStrainElements<Law>::tangent_moduli(const std::size_t element, const int pack,
                                              const Points (&strain_increment)[6], Points (&moduli)[6][6]) const
{
  for (int point = 0; point < points_per_pack; ++point)
  {
    Strain increment;
    for (int i = 0; i < 6; ++i)
      increment[i] = strain_increment[i][point];
    const Moduli at_point = [&]
    {
      if constexpr (std::is_same_v<Law, HypoplasticSand>)
        return consistent_tangent(law_, sand_state(point_history(element, pack), point), increment);
      else
        return law_.tangent(stress(element, points_per_pack * pack + point), increment);
    }();
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j < 6; ++j)
        moduli[i][j][point] = at_point[i][j];
  }
}

template <class Law>
std::vector<std::pair<std::string, std::span<double>>> SmallStrainElements<Law>::state()
{
  static_assert(sizeof(History) % sizeof(double) == 0);
  return {{"element_history",
           {reinterpret_cast<double *>(history_.data()), history_.size() * sizeof(History) / sizeof(double)}}};
}

template <class Law>
std::string SmallStrainElements<Law>::failure(const std::size_t element) const
{
  if constexpr (std::is_same_v<Law, HypoplasticSand>)
    for (int point = 0; point < points_per_pack * n_packs_; ++point)
      if (const Report report = report_[points_per_pack * n_packs_ * element + point]; report != Report::done)
        return explain(report, sand_state(point_history(element, point / points_per_pack), point % points_per_pack));
  return ElementGroup::failure(element);
}

template class SmallStrainElements<LinearElastic>;
template class SmallStrainElements<MohrCoulomb>;
template class SmallStrainElements<HypoplasticSand>;

} // namespace bergamo::fe
