#include "fe_dealii/element/finite_strain_solid.h"

#include "dem/core/error.h"

namespace bergamo::fe
{

template <class Law, int n_nodes>
FiniteStrainSolid<Law, n_nodes>::FiniteStrainSolid(const Law &law, std::vector<unsigned int> nodes,
                                                   std::vector<Geometry> geometry, MassShares mass_shares)
    : ElementGroup(n_nodes, std::move(nodes)), law_(law), geometry_(std::move(geometry)),
      mass_shares_(std::move(mass_shares)), energy_(geometry_.size(), 0.)
{
}

template <class Law, int n_nodes>
std::optional<std::size_t> FiniteStrainSolid<Law, n_nodes>::compute_forces(const std::size_t begin,
                                                                           const std::size_t end,
                                                                           const double *displacement, const double *)
{
  for (std::size_t e = begin; e < end; ++e)
  {
    if (is_rigid(e))
      continue;
    double u[3 * n_nodes];
    gather(e, displacement, u);
    const finite_strain::Response response = finite_strain::internal_force(law_, geometry_[e], dilatation, u, force(e));
    energy_[e] = response.energy;
    if (!(response.smallest_ratio > 0))
      return e;
  }
  return std::nullopt;
}

template <class Law, int n_nodes>
void FiniteStrainSolid<Law, n_nodes>::lumped_mass(const std::size_t element, double *mass) const
{
  const double whole = law_.density() * volume(element);
  for (int node = 0; node < n_nodes; ++node)
    mass[node] = whole * mass_shares_.lumped[n_nodes * element + node];
}

template <class Law, int n_nodes>
void FiniteStrainSolid<Law, n_nodes>::gravitational_mass(const std::size_t element, double *mass) const
{
  const double whole = law_.density() * volume(element);
  for (int node = 0; node < n_nodes; ++node)
    mass[node] = whole * mass_shares_.row_sum[n_nodes * element + node];
}

template <class Law, int n_nodes>
void FiniteStrainSolid<Law, n_nodes>::stiffness(const std::size_t element, const double *displacement,
                                                double *matrix) const
{
  double u[3 * n_nodes];
  gather(element, displacement, u);
  finite_strain::tangent_stiffness(law_, geometry_[element], dilatation, u, matrix);
}

template <class Law, int n_nodes>
void FiniteStrainSolid<Law, n_nodes>::set_share(std::span<const double>)
{
  throw ConfigError("continuum: a two-scale model shares no body of large strain; choose a linear elastic or a "
                    "Mohr-Coulomb material");
}

template <class Law, int n_nodes>
ElementState FiniteStrainSolid<Law, n_nodes>::state_of(const std::size_t element, const double *displacement) const
{
  double u[3 * n_nodes], present_volume = 0;
  gather(element, displacement, u);
  const Geometry &geometry = geometry_[element];
  for (int pack = 0; pack < n_packs; ++pack)
  {
    const Tensor3<Points> f = finite_strain::deformation_gradient(geometry, pack, u);
    present_volume += sum(geometry.volume[pack] * determinant(f, cofactor(f)));
  }
  ElementState state;
  constexpr int row[6] = {0, 1, 2, 0, 1, 2}, column[6] = {0, 1, 2, 1, 2, 0};
  for (int pack = 0; pack < n_packs; ++pack)
  {
    const Tensor3<Points> f = finite_strain::deformation_gradient(geometry, pack, u), minors = cofactor(f);
    const Points ratio = determinant(f, minors);
    const Tensor3<Points> first_piola = law_.respond(f, minors, ratio).stress;
    const Points pressure = dilatation == finite_strain::Dilatation::mean
                                ? Points(law_.volumetric().pressure(present_volume / volume(element)))
                                : law_.volumetric().pressure(ratio);
    // J σ = P F^T, and its integral over the reference volume is that of σ over the present one.
    for (int c = 0; c < 6; ++c)
    {
      Points kirchhoff = c < 3 ? pressure * ratio : Points{};
      for (int k = 0; k < 3; ++k)
        kirchhoff += first_piola[row[c]][k] * f[column[c]][k];
      state.stress[c] += sum(geometry.volume[pack] * kirchhoff) / present_volume;
    }
  }
  state.volume = present_volume;
  state.energy_density = energy_[element] / volume(element);
  return state;
}

template <class Law, int n_nodes>
double FiniteStrainSolid<Law, n_nodes>::elastic_energy() const
{
  double energy = 0;
  for (const double e : energy_)
    energy += e;
  return energy;
}

template class FiniteStrainSolid<NeoHooke, 8>;
template class FiniteStrainSolid<NeoHooke, 27>;
template class FiniteStrainSolid<MooneyRivlin, 8>;
template class FiniteStrainSolid<MooneyRivlin, 27>;
template class FiniteStrainSolid<Ogden, 8>;
template class FiniteStrainSolid<Ogden, 27>;

} // namespace bergamo::fe
