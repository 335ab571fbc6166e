#include "fe_dealii/element/small_strain_hexahedra.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace bergamo::fe
{

template <class Law>
SmallStrainHexahedra<Law>::SmallStrainHexahedra(const Law &law, std::vector<unsigned int> nodes,
                                                std::vector<hexahedron::Geometry> geometry,
                                                std::vector<typename SmallStrainElements<Law>::History> start)
    : SmallStrainElements<Law>(law, hexahedron::n_nodes, std::move(nodes), std::move(start), hexahedron::n_points),
      geometry_(std::move(geometry))
{
  constexpr double rounding = 1e-13;
  for (std::size_t e = 0; e < this->size(); ++e)
  {
    const Points(&stress)[6] = this->history(e).stress;
    const Points trace = stress[0] + stress[1] + stress[2];
    const double low = math::least(trace), high = -math::least(-trace);
    if (high - low > rounding * std::max(std::abs(low), std::abs(high)))
      start_stress_.resize(this->size());
  }
  for (std::size_t e = 0; e < start_stress_.size(); ++e)
    std::copy_n(this->history(e).stress, 6, start_stress_[e].component);
  find_start_force();
}

template <class Law>
void SmallStrainHexahedra<Law>::find_start_force()
{
  if (start_stress_.empty())
    return;
  std::vector<double> force(hexahedron::n_dofs * this->size());
  for (std::size_t e = 0; e < this->size(); ++e)
    hexahedron::unevenness_force(geometry_[e], start_stress_[e].component, &force[hexahedron::n_dofs * e]);
  start_force_ = StartForce(std::move(force), hexahedron::n_dofs);
}

template <class Law>
std::optional<std::size_t> SmallStrainHexahedra<Law>::compute_forces(const std::size_t begin, const std::size_t end,
                                                                     const double *displacement, const double *before)
{
  for (std::size_t e = begin; e < end; ++e)
  {
    if (this->is_rigid(e))
      continue;
    double increment[hexahedron::n_dofs];
    this->gather_increment(e, displacement, before, increment);
    Points strain[6];
    hexahedron::strain(geometry_[e], increment, strain);
    auto &history = this->history(e);
    if (!update_stress(this->law(), geometry_[e].share_volume, strain, history, this->reports(e)))
      return e;
    hexahedron::internal_force(geometry_[e], history.stress, this->force(e));
    if (start_force_.is_empty())
      continue;
    double u[hexahedron::n_dofs];
    this->gather(e, displacement, u);
    add_start_force(e, u);
  }
  return std::nullopt;
}

template <class Law>
double SmallStrainHexahedra<Law>::elastic_energy() const
{
  const auto &start = start_force_.energy();
  return std::accumulate(start.begin(), start.end(), SmallStrainElements<Law>::elastic_energy());
}

template <class Law>
std::vector<std::pair<std::string, std::span<double>>> SmallStrainHexahedra<Law>::state()
{
  auto views = SmallStrainElements<Law>::state();
  views.push_back({"element_start_energy", start_force_.energy()});
  return views;
}

template <class Law>
void SmallStrainHexahedra<Law>::lumped_mass(const std::size_t element, double *mass) const
{
  hexahedron::lumped_mass(this->law().density(), geometry_[element], mass);
}

template <class Law>
void SmallStrainHexahedra<Law>::stiffness(const std::size_t element, const double *, double *matrix) const
{
  elastic_stiffness(element, geometry_[element], matrix);
}

template <class Law>
void SmallStrainHexahedra<Law>::elastic_stiffness(const std::size_t element, const hexahedron::Geometry &shape,
                                                  double *matrix) const
{
  hexahedron::stiffness(
      shape,
      [&](const Points(&unit_strain)[6], Points(&stress)[6]) { elastic_stress(this->law(), unit_strain, stress); },
      matrix);
  const double factor = this->stiffness_factor(element);
  for (int entry = 0; entry < hexahedron::n_dofs * hexahedron::n_dofs; ++entry)
    matrix[entry] *= factor;
}

template <class Law>
void SmallStrainHexahedra<Law>::tangent(const std::size_t element, const double *displacement, const double *before,
                                        double *matrix) const
{
  double increment[hexahedron::n_dofs];
  this->gather_increment(element, displacement, before, increment);
  Points strain[6], moduli[6][6];
  hexahedron::strain(geometry_[element], increment, strain);
  this->tangent_moduli(element, 0, strain, moduli);
  hexahedron::stiffness(
      geometry_[element],
      [&](const Points(&unit_strain)[6], Points(&stress)[6]) { apply_moduli(moduli, unit_strain, stress); }, matrix);
}

template <class Law>
void SmallStrainHexahedra<Law>::set_share(const std::span<const double> nodal_share)
{
  for (std::size_t e = 0; e < this->size(); ++e)
    for (int point = 0; point < hexahedron::n_points; ++point)
    {
      double share = 0;
      for (int v = 0; v < hexahedron::n_nodes; ++v)
        share += hexahedron::shape_value(v, point) * nodal_share[this->nodes(e)[v]];
      geometry_[e].share_volume[point] = share * geometry_[e].volume[point];
    }
  find_start_force();
}

template class SmallStrainHexahedra<LinearElastic>;
template class SmallStrainHexahedra<MohrCoulomb>;
template class SmallStrainHexahedra<HypoplasticSand>;

} // namespace bergamo::fe
