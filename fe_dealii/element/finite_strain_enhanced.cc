#include "fe_dealii/element/finite_strain_enhanced.h"

#include "dem/core/error.h"

#include <numeric>

namespace bergamo::fe
{

using stabilized::n_dofs, stabilized::n_nodes;

template <class Law>
FiniteStrainEnhanced<Law>::FiniteStrainEnhanced(const Law &law, std::vector<unsigned int> nodes,
                                                std::vector<stabilized::Geometry> geometry,
                                                std::vector<double> node_volume)
    : ElementGroup(n_nodes, std::move(nodes)), law_(law), geometry_(std::move(geometry)),
      node_volume_(std::move(node_volume)), energy_(geometry_.size(), 0.)
{
}

template <class Law>
std::optional<std::size_t> FiniteStrainEnhanced<Law>::compute_forces(const std::size_t begin, const std::size_t end,
                                                                     const double *displacement, const double *)
{
  for (std::size_t e = begin; e < end; ++e)
  {
    if (is_rigid(e))
      continue;
    double u[n_dofs];
    gather(e, displacement, u);
    const stabilized::Response response = stabilized::internal_force(law_, geometry_[e], u, force(e));
    energy_[e] = response.energy;
    if (response.smallest_ratio <= 0)
      return e;
  }
  return std::nullopt;
}

template <class Law>
void FiniteStrainEnhanced<Law>::lumped_mass(const std::size_t element, double *mass) const
{
  for (int node = 0; node < n_nodes; ++node)
    mass[node] = law_.density() * node_volume_[n_nodes * element + node];
}

template <class Law>
void FiniteStrainEnhanced<Law>::stiffness(const std::size_t element, const double *displacement, double *matrix) const
{
  double u[n_dofs];
  gather(element, displacement, u);
  stabilized::tangent_stiffness(law_, geometry_[element], u, matrix);
}

template <class Law>
void FiniteStrainEnhanced<Law>::set_share(std::span<const double>)
{
  throw ConfigError("continuum: a two-scale model shares no body of large strain; choose a linear elastic or a "
                    "Mohr-Coulomb material");
}

template <class Law>
ElementState FiniteStrainEnhanced<Law>::state_of(const std::size_t element, const double *displacement) const
{
  double u[n_dofs];
  gather(element, displacement, u);
  const Tensor3<double> f = stabilized::Motion(geometry_[element], u).f;
  const Tensor3<double> piola = first_piola(law_, f);
  const double ratio = determinant(f, cofactor(f));
  ElementState state;
  constexpr int row[6] = {0, 1, 2, 0, 1, 2}, column[6] = {0, 1, 2, 1, 2, 0};
  for (int c = 0; c < 6; ++c)
    for (int k = 0; k < 3; ++k)
      state.stress[c] += piola[row[c]][k] * f[column[c]][k] / ratio;
  state.energy_density = energy_[element] / volume(element);
  return state;
}

template <class Law>
double FiniteStrainEnhanced<Law>::elastic_energy() const
{
  return std::accumulate(energy_.begin(), energy_.end(), 0.);
}

template class FiniteStrainEnhanced<NeoHooke>;
template class FiniteStrainEnhanced<MooneyRivlin>;
template class FiniteStrainEnhanced<Ogden>;

} // namespace bergamo::fe
