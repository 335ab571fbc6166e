#include "fe_dealii/element/solid_elements.h"

#include "dem/core/error.h"
#include "fe_dealii/element/cell_nodes.h"
#include "fe_dealii/element/finite_strain_bending.h"
#include "fe_dealii/element/finite_strain_solid.h"
#include "fe_dealii/element/large_strain_hexahedra.h"
#include "fe_dealii/element/small_strain_bending.h"
#include "fe_dealii/element/small_strain_hexahedra.h"
#include "fe_dealii/element/small_strain_quadratic.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/grid/tria.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <sstream>
#include <type_traits>

namespace bergamo::fe
{
namespace
{

/// Of a body: all, or those of one material id.
struct Cells
{
  const dealii::DoFHandler<3> &dof_handler;
  std::optional<unsigned int> material_id;
};

/// @param take take(values): called with the values of each cell, in the order of the cells
template <class Take>
void for_each_cell(const Cells &cells, const unsigned int degree, const Take &take)
{
  const dealii::FE_Q<3> scalar(degree);
  const dealii::QGauss<3> quadrature(degree + 1);
  dealii::FEValues<3> values(scalar, quadrature,
                             dealii::update_values | dealii::update_gradients | dealii::update_JxW_values |
                                 dealii::update_quadrature_points);
  for (const auto &cell : cells.dof_handler.get_triangulation().active_cell_iterators())
  {
    values.reinit(cell); // of all: deal.II takes over what a cell has in common with the one before, rounding included
    if (cells.material_id && cell->material_id() != *cells.material_id)
      continue;
    for (unsigned int point = 0; point < values.n_quadrature_points; ++point)
      if (!(values.JxW(point) > 0))
      {
        std::ostringstream message;
        message << "mesh: cell " << cell->active_cell_index() << " at " << cell->center()
                << " is turned inside out at one of its corners (volume " << values.JxW(point)
                << " m^3 at a quadrature point); repair the mesh";
        throw ConfigError(message.str());
      }
    take(values);
  }
}

template <class Law>
void check_initial_stress(const Law &law, const Stress &stress, const dealii::Point<3> &place)
{
  double excess = 0, scale = 0;
  for (const double component : stress)
    scale += std::abs(component);
  if constexpr (std::is_same_v<Law, MohrCoulomb>)
    excess = law.yield_function(stress);
  constexpr double rounding = 1e-12;
  if (std::isfinite(scale) && excess <= rounding * scale)
    return;
  std::ostringstream message;
  message << "continuum: the initial stress at (" << place << ") m, xx " << stress[0] << " yy " << stress[1] << " zz "
          << stress[2] << " xy " << stress[3] << " yz " << stress[4] << " zx " << stress[5] << " Pa, ";
  if (std::isfinite(scale))
    message << "is " << excess << " Pa beyond the yield surface; choose one that the material bears";
  else
    message << "is not finite; give numbers";
  throw ConfigError(message.str());
}

/// Sand bears no tension, and has a void ratio between the limits of its pressure.
void check_initial_state(const HypoplasticSand &law, const SandState &state, const dealii::Point<3> &place)
{
  const double greatest = principal_frame(state.stress).value[0];
  const double pressure = std::max(0., -mean_stress(state.stress));
  const LimitVoidRatios limits = law.limit_void_ratios(pressure);
  const double e = state.void_ratio;
  std::ostringstream message;
  if (!(greatest <= 0)) // nor a NaN
    message << "continuum: the initial stress at (" << place << ") m has a principal stress of " << greatest
            << " Pa; sand bears no tension, choose one of compression";
  else if (e < limits.densest || e > limits.loosest)
    message << "continuum: initial_void_ratio = " << e << " is not allowed at (" << place << ") m; under a pressure of "
            << pressure << " Pa choose it between e_d = " << limits.densest << " and e_i = " << limits.loosest;
  if (!message.str().empty())
    throw ConfigError(message.str());
}

/// The points of a cell at rest.
template <class Law>
void add_start(const dealii::FEValues<3> &values, const Law &law, const InitialStress &initial_stress,
               std::vector<typename KeptAtPoints<Law>::History> &start)
{
  const unsigned int n_points = values.n_quadrature_points;
  const std::size_t first = start.size();
  start.resize(first + (n_points + points_per_pack - 1) / points_per_pack, {});
  if constexpr (std::is_same_v<Law, HypoplasticSand>)
    for (std::size_t pack = first; pack < start.size(); ++pack)
      start[pack].void_ratio = Points(law.parameters().initial_void_ratio);
  if (!initial_stress)
  {
    if constexpr (std::is_same_v<Law, HypoplasticSand>)
      check_initial_state(law, sand_state(start[first], 0), values.quadrature_point(0));
    return;
  }
  for (unsigned int point = 0; point < n_points; ++point)
  {
    const dealii::Point<3> &place = values.quadrature_point(point);
    const Stress stress = initial_stress({place[0], place[1], place[2]});
    if constexpr (std::is_same_v<Law, HypoplasticSand>)
      check_initial_state(law, {stress, law.parameters().initial_void_ratio}, place);
    else
      check_initial_stress(law, stress, place);
    auto &history = start[first + point / points_per_pack];
    for (int i = 0; i < 6; ++i)
      history.stress[i][point % points_per_pack] = stress[i];
    if constexpr (std::is_same_v<Law, MohrCoulomb>)
      history.plastic_strain[point % points_per_pack] = law.mobilising_strain(stress);
  }
}

template <class Elements, class Law>
std::unique_ptr<ElementGroup> trilinear(const Cells &cells, const Law &law, const InitialStress &initial_stress)
{
  std::vector<typename KeptAtPoints<Law>::History> start;
  std::vector<hexahedron::Geometry> geometries;
  for_each_cell(cells, 1,
                [&](const dealii::FEValues<3> &values)
                {
                  hexahedron::Geometry geometry;
                  for (int point = 0; point < hexahedron::n_points; ++point)
                  {
                    geometry.volume[point] = values.JxW(point);
                    for (int node = 0; node < hexahedron::n_nodes; ++node)
                      for (int i = 0; i < 3; ++i)
                        geometry.gradient[i][node][point] = values.shape_grad(node, point)[i];
                  }
                  geometry.share_volume = geometry.volume;
                  geometry.volume_fraction = geometry.volume / sum(geometry.volume);
                  geometries.push_back(geometry);
                  add_start(values, law, initial_stress, start);
                });
  return std::make_unique<Elements>(law, cell_nodes(cells.dof_handler, cells.material_id), std::move(geometries),
                                    std::move(start));
}

bending::Corners corners_of(const dealii::FEValues<3> &values)
{
  bending::Corners corners;
  for (int node = 0; node < bending::n_nodes; ++node)
    for (int i = 0; i < 3; ++i)
      corners[node][i] = values.get_cell()->vertex(node)[i];
  return corners;
}

template <class Law>
std::unique_ptr<ElementGroup> small_strain_bending(const Cells &cells, const Law &law,
                                                   const InitialStress &initial_stress)
{
  std::vector<typename KeptAtPoints<Law>::History> start;
  std::vector<bending::Corners> corners;
  for_each_cell(cells, 1,
                [&](const dealii::FEValues<3> &values)
                {
                  corners.push_back(corners_of(values));
                  add_start(values, law, initial_stress, start);
                });
  return std::make_unique<SmallStrainBending<Law>>(law, cell_nodes(cells.dof_handler, cells.material_id),
                                                   std::move(corners), start);
}

/// Geometries and lumped masses of elements that are integrated in full.
template <int n_nodes>
struct Solids
{
  using Geometry = SolidGeometry<n_nodes, packs_of(n_nodes)>;
  std::vector<Geometry> geometry;
  MassShares mass_shares;

  /// Inertia of 8 nodes by row sums: they are positive, keep the centre of mass, and gravity accelerates all nodes
  /// alike. That of 27 by the diagonal of the consistent matrix, scaled to the whole (Hinton, Rock, Zienkiewicz,
  /// Earthq. Eng. Struct. Dyn. 4 (1976) 245-249): positive for any element, where the row sum is not; on bricks,
  /// Simpson's rule and the row sum.
  /// @param take take(values): called with the values of each cell
  template <class Take>
  Solids(const Cells &cells, const Take &take)
  {
    for_each_cell(cells, n_nodes == 8 ? 1 : 2,
                  [&](const dealii::FEValues<3> &values)
                  {
                    add(values);
                    take(values);
                  });
  }

private:
  void add(const dealii::FEValues<3> &values)
  {
    Geometry cell{};
    std::array<double, n_nodes> diagonal{}, row_sum{};
    for (unsigned int point = 0; point < values.n_quadrature_points; ++point)
    {
      const unsigned int pack = point / points_per_pack, lane = point % points_per_pack;
      cell.volume[pack][lane] = values.JxW(point);
      for (int node = 0; node < n_nodes; ++node)
      {
        for (int i = 0; i < 3; ++i)
          cell.gradient[pack][i][node][lane] = values.shape_grad(node, point)[i];
        const double value = values.shape_value(node, point);
        diagonal[node] += value * value * values.JxW(point);
        row_sum[node] += value * values.JxW(point);
      }
    }
    add_shares(row_sum, mass_shares.row_sum);
    add_shares(n_nodes == 8 ? row_sum : diagonal, mass_shares.lumped);
    geometry.push_back(cell);
  }

  static void add_shares(const std::array<double, n_nodes> &part, std::vector<double> &shares)
  {
    const double whole = std::accumulate(part.begin(), part.end(), 0.);
    for (const double p : part)
      shares.push_back(p / whole);
  }
};

template <class Law>
std::unique_ptr<ElementGroup> small_strain_quadratic(const Cells &cells, const Law &law,
                                                     const InitialStress &initial_stress)
{
  std::vector<typename KeptAtPoints<Law>::History> start;
  Solids<27> solids(cells, [&](const dealii::FEValues<3> &values) { add_start(values, law, initial_stress, start); });
  return std::make_unique<SmallStrainQuadratic<Law>>(law, cell_nodes(cells.dof_handler, cells.material_id),
                                                     std::move(solids.geometry), std::move(solids.mass_shares),
                                                     std::move(start));
}

template <class Law, int n_nodes>
std::unique_ptr<ElementGroup> finite_strain(const Cells &cells, const Law &law)
{
  Solids<n_nodes> solids(cells, [](const dealii::FEValues<3> &) {});
  return std::make_unique<FiniteStrainSolid<Law, n_nodes>>(law, cell_nodes(cells.dof_handler, cells.material_id),
                                                           std::move(solids.geometry), std::move(solids.mass_shares));
}

template <class Law>
std::unique_ptr<ElementGroup> finite_strain_bending(const Cells &cells, const Law &law)
{
  std::vector<bending::Corners> corners;
  for_each_cell(cells, 1, [&](const dealii::FEValues<3> &values) { corners.push_back(corners_of(values)); });
  return std::make_unique<FiniteStrainBending<Law>>(law, cell_nodes(cells.dof_handler, cells.material_id),
                                                    std::move(corners));
}

struct Maker
{
  Cells cells;
  const InitialStress &initial_stress;
  SolidKind kind;

  unsigned int degree() const { return cells.dof_handler.get_fe().degree; }

  template <class Law>
  std::unique_ptr<ElementGroup> of_small_strain(const Law &law) const
  {
    const bool bends = kind.hourglass == Hourglass::bending;
    if (kind.kinematics == Kinematics::large_strain)
    {
      if (degree() == 2 || bends)
        throw ConfigError(
            "continuum: a law of small strain is carried through large strain by elements of 8 nodes alone "
            "that do not bend; choose these, or small strain");
      return trilinear<LargeStrainHexahedra<Law>>(cells, law, initial_stress);
    }
    if (degree() == 2)
      return small_strain_quadratic(cells, law, initial_stress);
    return bends ? small_strain_bending(cells, law, initial_stress)
                 : trilinear<SmallStrainHexahedra<Law>>(cells, law, initial_stress);
  }

  template <class Law>
  std::unique_ptr<ElementGroup> of_large_strain(const Law &law) const
  {
    if (initial_stress)
      throw ConfigError("continuum: initial_stress is given for a law of large strain, which has no stress at rest; "
                        "leave it out");
    if (degree() == 2)
      return finite_strain<Law, 27>(cells, law);
    return kind.hourglass == Hourglass::bending ? finite_strain_bending(cells, law) : finite_strain<Law, 8>(cells, law);
  }

  std::unique_ptr<ElementGroup> operator()(const LinearElastic &law) const { return of_small_strain(law); }
  std::unique_ptr<ElementGroup> operator()(const MohrCoulomb &law) const { return of_small_strain(law); }
  std::unique_ptr<ElementGroup> operator()(const HypoplasticSand &law) const { return of_small_strain(law); }
  std::unique_ptr<ElementGroup> operator()(const NeoHooke &law) const { return of_large_strain(law); }
  std::unique_ptr<ElementGroup> operator()(const MooneyRivlin &law) const { return of_large_strain(law); }
  std::unique_ptr<ElementGroup> operator()(const Ogden &law) const { return of_large_strain(law); }
};

} // namespace

std::unique_ptr<ElementGroup> make_solid_elements(const dealii::DoFHandler<3, 3> &dof_handler, const Material &material,
                                                  const InitialStress &initial_stress, const SolidKind &kind,
                                                  const std::optional<unsigned int> material_id)
{
  return std::visit(Maker{{dof_handler, material_id}, initial_stress, kind}, material);
}

} // namespace bergamo::fe
