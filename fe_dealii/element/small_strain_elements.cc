#include "fe_dealii/element/small_strain_elements.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace bergamo::fe
{

template <class Law>
SmallStrainElements<Law>::SmallStrainElements(const Law &law, const int nodes_per_element,
                                              std::vector<unsigned int> nodes, std::vector<History> start,
                                              const int lanes_per_element)
    : ElementGroup(nodes_per_element, std::move(nodes)), law_(law), n_lanes_(lanes_per_element),
      history_(std::move(start)), report_(points_per_pack * history_.size(), Report{})
{
}

template <class Law>
double SmallStrainElements<Law>::volume(const std::size_t element) const
{
  double result = 0;
  for (int point = 0; point < n_lanes_; ++point)
    result += point_volume(element, point);
  return result;
}

template <class Law>
Stress SmallStrainElements<Law>::stress(const std::size_t element, const int point) const
{
  Stress result;
  for (int i = 0; i < 6; ++i)
    result[i] = history_of(element, point).stress[i][lane_of(element, point)];
  return result;
}

template <class Law>
ElementState SmallStrainElements<Law>::state_of(const std::size_t element, const double *) const
{
  ElementState state;
  const double whole = state.volume = volume(element);
  for (int point = 0; point < n_lanes_; ++point)
  {
    const double fraction = point_volume(element, point) / whole;
    const Stress at_point = stress(element, point);
    for (int i = 0; i < 6; ++i)
      state.stress[i] += fraction * at_point[i];
    state.plastic_strain += fraction * history_of(element, point).plastic_strain[lane_of(element, point)];
    if constexpr (std::is_same_v<Law, HypoplasticSand>)
      state.void_ratio += fraction * history_of(element, point).void_ratio[lane_of(element, point)];
    state.energy_density += fraction * stored_energy(element, point);
  }
  if constexpr (std::is_same_v<Law, MohrCoulomb>)
    state.yield_function = law_.yield_function(state.stress, state.plastic_strain);
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
    for (int point = 0; point < n_lanes_; ++point)
      energy += point_share_volume(e, point) * stored_energy(e, point);
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
      double least_mean = HUGE_VAL, checked = 0;
      for (int point = 0; point < n_lanes_; ++point)
      {
        const double mean = mean_stress(stress(element, point));
        least_mean = std::min(least_mean, mean);
        checked += mean;
      }
      return std::isfinite(checked) ? law_.stiffness_factor(least_mean) : checked;
    }
  if constexpr (std::is_same_v<Law, HypoplasticSand>)
  {
    double greatest = 0, checked = 0;
    for (int point = 0; point < n_lanes_; ++point)
    {
      const double factor = law_.stiffness_factor(sand_state(history_of(element, point), lane_of(element, point)));
      greatest = std::max(greatest, factor);
      checked += factor;
    }
    return std::isfinite(checked) ? greatest : checked;
  }
  return 1;
}

template <class Law>
Moduli SmallStrainElements<Law>::tangent_moduli(const std::size_t element, const int point,
                                                const Strain &strain_increment) const
{
  if constexpr (std::is_same_v<Law, HypoplasticSand>)
    return consistent_tangent(law_, sand_state(history_of(element, point), lane_of(element, point)), strain_increment);
  else if constexpr (std::is_same_v<Law, MohrCoulomb>)
    return law_.tangent(stress(element, point), strain_increment,
                        history_of(element, point).plastic_strain[lane_of(element, point)]);
  else
    return law_.tangent(stress(element, point), strain_increment);
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
    const Moduli at_point = tangent_moduli(element, points_per_pack * pack + point, increment);
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j < 6; ++j)
        moduli[i][j][point] = at_point[i][j];
  }
}

template <class Law>
bool SmallStrainElements<Law>::has_symmetric_tangent() const
{
  if constexpr (std::is_same_v<Law, MohrCoulomb>)
    return !law_.hardens() && law_.parameters().friction_angle == law_.parameters().dilation_angle;
  else
    return std::is_same_v<Law, LinearElastic>;
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
    for (int point = 0; point < n_lanes_; ++point)
      if (const Report report = report_[n_lanes_ * element + point]; report != Report::done)
        return explain(report, sand_state(history_of(element, point), lane_of(element, point)));
  return ElementGroup::failure(element);
}

template class SmallStrainElements<LinearElastic>;
template class SmallStrainElements<MohrCoulomb>;
template class SmallStrainElements<HypoplasticSand>;

} // namespace bergamo::fe
