#include "fe_dealii/element/large_strain_hexahedra.h"

#include "fe_dealii/element/difference_tangent.h"
#include "fe_dealii/element/present_shape.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace bergamo::fe
{

template <class Law>
bool LargeStrainHexahedra<Law>::carry(const std::size_t element, const double *now, const double *before,
                                      History &history, Report *report, double *force) const
{
  const hexahedron::Geometry &reference = this->geometry(element);
  double increment[hexahedron::n_dofs], middle[hexahedron::n_dofs];
  for (int dof = 0; dof < hexahedron::n_dofs; ++dof)
  {
    increment[dof] = now[dof] - before[dof];
    middle[dof] = before[dof] + 0.5 * increment[dof];
  }
  const PresentShape between = present_shape(reference, middle), shape = present_shape(reference, now);
  if (!(between.smallest_ratio > 0) || !(shape.smallest_ratio > 0))
    return false;
  const Spin half_turn = half_of(spin(between.geometry, increment));
  turn(half_turn, history.stress);
  Points strain[6];
  hexahedron::strain(between.geometry, increment, strain);
  if (!update_stress(this->law(), reference.share_volume, strain, history, report))
    return false;
  turn(half_turn, history.stress);
  hexahedron::internal_force(shape.geometry, history.stress, force);
  return true;
}

template <class Law>
std::optional<std::size_t> LargeStrainHexahedra<Law>::compute_forces(const std::size_t begin, const std::size_t end,
                                                                     const double *displacement, const double *before)
{
  for (std::size_t e = begin; e < end; ++e)
  {
    if (this->is_rigid(e))
      continue;
    double u[hexahedron::n_dofs], u_before[hexahedron::n_dofs];
    this->gather(e, displacement, u);
    this->gather(e, before, u_before);
    if (!carry(e, u, u_before, this->history(e), this->reports(e), this->force(e)))
      return e;
    this->add_start_force(e, u);
  }
  return std::nullopt;
}

template <class Law>
void LargeStrainHexahedra<Law>::stiffness(const std::size_t element, const double *displacement, double *matrix) const
{
  double u[hexahedron::n_dofs];
  this->gather(element, displacement, u);
  this->elastic_stiffness(element, present_shape(this->geometry(element), u).geometry, matrix);
}

template <class Law>
void LargeStrainHexahedra<Law>::tangent(const std::size_t element, const double *displacement, const double *before,
                                        double *matrix) const
{
  double u[hexahedron::n_dofs], u_before[hexahedron::n_dofs];
  this->gather(element, displacement, u);
  this->gather(element, before, u_before);
  difference_matrix<hexahedron::n_dofs>(
      [&](const double *moved, double *force)
      {
        History history = this->history(element);
        Report report[points_per_pack];
        if (!carry(element, moved, u_before, history, report, force))
          std::fill_n(force, hexahedron::n_dofs, std::nan(""));
      },
      u, 1e-5 * std::cbrt(this->volume(element)), matrix);
}

template <class Law>
ElementState LargeStrainHexahedra<Law>::state_of(const std::size_t element, const double *displacement) const
{
  ElementState state = SmallStrainHexahedra<Law>::state_of(element, displacement);
  double u[hexahedron::n_dofs];
  this->gather(element, displacement, u);
  state.volume = present_shape(this->geometry(element), u).volume;
  for (double &component : state.stress) // of J sigma over the reference volume, so far
    component *= this->volume(element) / state.volume;
  if constexpr (std::is_same_v<Law, MohrCoulomb>)
    state.yield_function *= this->volume(element) / state.volume;
  return state;
}

template class LargeStrainHexahedra<LinearElastic>;
template class LargeStrainHexahedra<MohrCoulomb>;
template class LargeStrainHexahedra<HypoplasticSand>;

} // namespace bergamo::fe
