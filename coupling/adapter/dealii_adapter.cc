#include "coupling/adapter/dealii_adapter.h"

#include "dem/core/error.h"

#include <deal.II/base/geometry_info.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_q1.h>

#include <Eigen/LU>

#include <algorithm>
#include <map>
#include <string>

namespace bergamo::coupling
{
namespace
{

using Cell = dealii::Triangulation<3>::cell_iterator;

/// Boxes around the cells' corners, to try only cells that a point may lie in.
struct CellBox
{
  Cell cell;
  unsigned int element;
  Vec3 low, high;

  bool may_hold(const Vec3 &x) const { return (x.array() >= low.array()).all() && (x.array() <= high.array()).all(); }
};

std::vector<CellBox> cell_boxes(const fe::ExplicitBody &body)
{
  std::vector<CellBox> boxes;
  for (const auto &cell : body.dof_handler().active_cell_iterators())
  {
    CellBox box{cell, static_cast<unsigned int>(boxes.size()), Vec3::Constant(1e300), Vec3::Constant(-1e300)};
    for (const unsigned int v : cell->vertex_indices())
      for (int d = 0; d < 3; ++d)
      {
        box.low[d] = std::min(box.low[d], cell->vertex(v)[d]);
        box.high[d] = std::max(box.high[d], cell->vertex(v)[d]);
      }
    boxes.push_back(box);
  }
  return boxes;
}

/// Local coordinates in [0, 1]^3 of a point in a cell; false if it lies outside.
bool find_in_cell(const Cell &cell, const Vec3 &x, dealii::Point<3> &unit)
{
  try
  {
    unit = dealii::StaticMappingQ1<3>::mapping.transform_real_to_unit_cell(cell, dealii::Point<3>(x[0], x[1], x[2]));
  }
  catch (const dealii::Mapping<3>::ExcTransformationFailed &)
  {
    return false;
  }
  return dealii::GeometryInfo<3>::is_inside_unit_cell(unit);
}

/// Gradients of the shape functions in space [1/m].
std::array<Vec3, 8> gradients_at(const dealii::FE_Q<3> &trilinear, const Cell &cell, const dealii::Point<3> &unit)
{
  std::array<Vec3, 8> local;
  Eigen::Matrix3d jacobian = Eigen::Matrix3d::Zero(); // dx / d unit
  for (unsigned int v = 0; v < 8; ++v)
  {
    const auto gradient = trilinear.shape_grad(v, unit);
    const auto &x = cell->vertex(v);
    local[v] = {gradient[0], gradient[1], gradient[2]};
    jacobian += Vec3(x[0], x[1], x[2]) * local[v].transpose();
  }
  const Eigen::Matrix3d inverse_transposed = jacobian.inverse().transpose();
  for (Vec3 &gradient : local)
    gradient = inverse_transposed * gradient;
  return local;
}

} // namespace

Overlap make_overlap(const fe::ExplicitBody &body, const std::span<const std::int64_t> id,
                     const std::span<const Vec3> position, const std::span<const double> volume)
{
  if (body.elements().nodes_per_element() != 8)
    throw ConfigError("grains overlap a continuum with elements of " +
                      std::to_string(body.elements().nodes_per_element()) +
                      " nodes; choose elements of degree 1, with 8 nodes");
  Overlap overlap;
  std::map<unsigned int, int> local_node; // node of the mesh -> place in overlap.nodes
  std::map<unsigned int, Cell> coupled_cells;
  const auto place_of = [&](const unsigned int node)
  {
    const auto [place, is_new] = local_node.emplace(node, static_cast<int>(overlap.nodes.size()));
    if (is_new)
    {
      const auto &x = body.node_position()[node];
      overlap.nodes.push_back(static_cast<int>(node));
      overlap.node_position.emplace_back(x[0], x[1], x[2]);
    }
    return place->second;
  };

  const std::vector<CellBox> boxes = cell_boxes(body);
  const dealii::FE_Q<3> trilinear(1);
  for (std::size_t i = 0; i < position.size(); ++i)
    for (const CellBox &box : boxes)
    {
      dealii::Point<3> unit;
      if (!box.may_hold(position[i]) || !find_in_cell(box.cell, position[i], unit))
        continue;
      const auto nodes = body.element_nodes(box.element);
      const std::array<Vec3, 8> gradients = gradients_at(trilinear, box.cell, unit);
      for (unsigned int v = 0; v < 8; ++v)
      {
        overlap.shape_gradient.push_back(gradients[v]);
        overlap.shape_node.push_back(place_of(nodes[v]));
        overlap.shape_value.push_back(std::clamp(trilinear.shape_value(v, unit), 0., 1.));
      }
      overlap.shape_offset.push_back(overlap.shape_node.size());
      overlap.particle_id.push_back(id[i]);
      overlap.particle_volume.push_back(volume[i]);
      overlap.reference_position.push_back(position[i]);
      coupled_cells.emplace(box.element, box.cell);
      break;
    }
  if (overlap.nodes.empty())
    throw ConfigError("grains and continuum do not overlap: no grain's centre lies in an element; let the "
                      "elements reach into the grains by at least one layer");

  std::vector<Eigen::Triplet<double>> entries;
  dealii::FEValues<3> values(trilinear, dealii::QGauss<3>(2), dealii::update_values | dealii::update_JxW_values);
  for (const auto &[element, cell] : coupled_cells)
  {
    values.reinit(cell);
    const auto nodes = body.element_nodes(element);
    for (const unsigned int q : values.quadrature_point_indices())
      for (unsigned int a = 0; a < 8; ++a)
        for (unsigned int b = 0; b < 8; ++b)
          entries.emplace_back(local_node.at(nodes[a]), local_node.at(nodes[b]),
                               values.shape_value(a, q) * values.shape_value(b, q) * values.JxW(q));
  }
  overlap.volume_matrix.resize(overlap.nodes.size(), overlap.nodes.size());
  overlap.volume_matrix.setFromTriplets(entries.begin(), entries.end());
  overlap.validate();
  return overlap;
}

} // namespace bergamo::coupling
