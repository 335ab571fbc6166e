#include "fe_dealii/element/small_strain_hexahedra.h"

#include <type_traits>

namespace bergamo::fe
{

template <class Law>
SmallStrainHexahedra<Law>::SmallStrainHexahedra(const Law &law, std::vector<unsigned int> nodes,
                                                std::vector<hexahedron::Geometry> geometry,
                                                const double initial_pressure)
    : ElementGroup(hexahedron::n_nodes, std::move(nodes)), law_(law), geometry_(std::move(geometry)),
      sector_(hexahedron::n_points * geometry_.size(), Sector::elastic)
{
  hexahedron::History initial{};
  for (int i = 0; i < 3; ++i)
    initial.stress[i] -= initial_pressure;
  history_.assign(geometry_.size(), initial);
}

template <class Law>
std::optional<std::size_t> SmallStrainHexahedra<Law>::compute_forces(const std::size_t begin, const std::size_t end,
                                                                     const double *displacement, const double *before)
{
  for (std::size_t e = begin; e < end; ++e)
  {
    double now[hexahedron::n_dofs], increment[hexahedron::n_dofs];
    gather(e, displacement, now);
    gather(e, before, increment);
    for (int dof = 0; dof < hexahedron::n_dofs; ++dof)
      increment[dof] = now[dof] - increment[dof];
    Points strain[6];
    hexahedron::strain(geometry_[e], increment, strain);
    hexahedron::update_stress(law_, geometry_[e], strain, history_[e], &sector_[hexahedron::n_points * e]);
    hexahedron::internal_force(geometry_[e], history_[e].stress, force(e));
  }
  return std::nullopt;
}

template <class Law>
void SmallStrainHexahedra<Law>::lumped_mass(const std::size_t element, double *mass) const
{
  hexahedron::lumped_mass(law_.density(), geometry_[element], mass);
}

template <class Law>
void SmallStrainHexahedra<Law>::stiffness(const std::size_t element, const double *, double *matrix) const
{
  hexahedron::elastic_stiffness(law_, geometry_[element], matrix);
}

template <class Law>
void SmallStrainHexahedra<Law>::set_share(const std::span<const double> nodal_share)
{
  for (std::size_t e = 0; e < size(); ++e)
    for (int point = 0; point < hexahedron::n_points; ++point)
    {
      double share = 0;
      for (int v = 0; v < hexahedron::n_nodes; ++v)
        share += hexahedron::shape_value(v, point) * nodal_share[nodes(e)[v]];
      geometry_[e].share_volume[point] = share * geometry_[e].volume[point];
    }
}

template <class Law>
Stress SmallStrainHexahedra<Law>::stress(const std::size_t element, const int point) const
{
  Stress result;
  for (int i = 0; i < 6; ++i)
    result[i] = history_[element].stress[i][point];
  return result;
}

template <class Law>
ElementState SmallStrainHexahedra<Law>::state_of(const std::size_t element, const double *) const
{
  const Points &fraction = geometry_[element].volume_fraction;
  ElementState state;
  for (int i = 0; i < 6; ++i)
    state.stress[i] = sum(fraction * history_[element].stress[i]);
  if constexpr (std::is_same_v<Law, MohrCoulomb>)
    state.yield_function = law_.yield_function(state.stress);
  state.plastic_strain = sum(fraction * history_[element].plastic_strain);
  return state;
}

template <class Law>
double SmallStrainHexahedra<Law>::elastic_energy() const
{
  double energy = 0;
  for (std::size_t e = 0; e < size(); ++e)
    for (int point = 0; point < hexahedron::n_points; ++point)
      energy += geometry_[e].share_volume[point] *
                elastic_energy_density(stress(e, point), law_.bulk_modulus(), law_.shear_modulus());
  return energy;
}

template <class Law>
double SmallStrainHexahedra<Law>::dissipated_energy() const
{
  double energy = 0;
  for (const hexahedron::History &history : history_)
    energy += sum(history.dissipated_energy);
  return energy;
}

template <class Law>
std::vector<std::pair<std::string, std::span<double>>> SmallStrainHexahedra<Law>::state()
{
  static_assert(sizeof(hexahedron::History) % sizeof(double) == 0);
  return {
      {"element_history",
       {reinterpret_cast<double *>(history_.data()), history_.size() * sizeof(hexahedron::History) / sizeof(double)}}};
}

template class SmallStrainHexahedra<LinearElastic>;
template class SmallStrainHexahedra<MohrCoulomb>;

} // namespace bergamo::fe
