#include "coupling/adapter/dealii_adapter.h"

#include "dem/core/error.h"

#include <deal.II/base/bounding_box.h>
#include <deal.II/base/geometry_info.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/mapping_q1.h>
#include <deal.II/numerics/rtree.h>

#include <Eigen/LU>

#include <algorithm>
#include <iterator>
#include <map>
#include <optional>
#include <string>
#include <utility>

namespace bergamo::coupling
{
namespace
{

using Cell = dealii::Triangulation<3>::cell_iterator;

/// Looks for the elements of a body's reference configuration that points lie in. Absent ones hold none, nor do those
/// that weights will make so.
class ElementSearch
{
public:
  struct Found
  {
    Cell cell;
    unsigned int element;
    dealii::Point<3> unit; // local coordinates in [0, 1]^3
  };

  explicit ElementSearch(const fe::ExplicitBody &body, const std::span<const double> nodal_weight = {})
  {
    const auto has_share = [&](const std::size_t element)
    {
      const auto nodes = body.element_nodes(element);
      return nodal_weight.empty() ||
             std::any_of(nodes.begin(), nodes.end(), [&](const auto node) { return nodal_weight[node] < 1.; });
    };
    std::vector<std::pair<dealii::BoundingBox<3>, unsigned int>> boxes;
    for (const auto &cell : body.dof_handler().active_cell_iterators())
    {
      if (!body.is_absent(cells_.size()) && has_share(cells_.size()))
        boxes.emplace_back(cell->bounding_box(), static_cast<unsigned int>(cells_.size()));
      cells_.push_back(cell);
    }
    tree_ = dealii::pack_rtree(boxes);
  }

  /// That of least number; none outside of the body.
  std::optional<Found> find(const Vec3 &place) const
  {
    const dealii::Point<3> x(place[0], place[1], place[2]);
    for (const unsigned int element : elements_about(x))
    {
      const auto unit = unit_place(cells_[element], x);
      if (unit && dealii::GeometryInfo<3>::is_inside_unit_cell(*unit))
        return Found{cells_[element], element, *unit};
    }
    return {};
  }

  /// The nearest place of those elements whose boxes are not further than `reach`, if it is not further itself [m]:
  /// along the local coordinates, so of a box exactly.
  std::optional<Found> find_near(const Vec3 &place, const double reach) const
  {
    if (const auto inside = find(place); inside || reach <= 0.)
      return inside;
    const dealii::Point<3> x(place[0], place[1], place[2]);
    const dealii::Tensor<1, 3> corner = dealii::Point<3>(reach, reach, reach);
    std::optional<Found> nearest;
    double least = reach;
    for (const unsigned int element : elements_about(dealii::BoundingBox<3>(std::pair(x - corner, x + corner))))
    {
      const auto unit = unit_place(cells_[element], x);
      if (!unit)
        continue;
      const dealii::Point<3> inside = dealii::GeometryInfo<3>::project_to_unit_cell(*unit);
      const double distance =
          x.distance(dealii::StaticMappingQ1<3>::mapping.transform_unit_to_real_cell(cells_[element], inside));
      if (distance > least || (nearest && distance == least))
        continue;
      least = distance;
      nearest = Found{cells_[element], element, inside};
    }
    return nearest;
  }

  /// From a place to the nearest box about an element [m].
  double distance_to(const Vec3 &place) const
  {
    const dealii::Point<3> x(place[0], place[1], place[2]);
    std::vector<std::pair<dealii::BoundingBox<3>, unsigned int>> nearest;
    tree_.query(boost::geometry::index::nearest(x, 1), std::back_inserter(nearest));
    return boost::geometry::distance(x, nearest.front().first);
  }

private:
  /// By number, those whose boxes meet a point or a box.
  template <class Shape>
  std::vector<unsigned int> elements_about(const Shape &shape) const
  {
    std::vector<unsigned int> elements;
    for (auto it = tree_.qbegin(boost::geometry::index::intersects(shape)); it != tree_.qend(); ++it)
      elements.push_back(it->second);
    std::sort(elements.begin(), elements.end());
    return elements;
  }

  static std::optional<dealii::Point<3>> unit_place(const Cell &cell, const dealii::Point<3> &x)
  {
    try
    {
      return dealii::StaticMappingQ1<3>::mapping.transform_real_to_unit_cell(cell, x);
    }
    catch (const dealii::Mapping<3>::ExcTransformationFailed &)
    {
      return {};
    }
  }

  std::vector<Cell> cells_;
  dealii::RTree<std::pair<dealii::BoundingBox<3>, unsigned int>> tree_;
};

const dealii::FE_Q<3> &trilinear()
{
  static const dealii::FE_Q<3> element(1);
  return element;
}

/// A particle in an element, or beside it.
struct Placed
{
  std::size_t particle;
  ElementSearch::Found at;
};

/// The particles that lie in elements, element by element, and in one in the order in which they came; and those that
/// lie in none, at the nearest place, where that is not further than `reach` [m] and weighs less than 1.
std::vector<Placed> placed_by_element(const fe::ExplicitBody &body, const std::span<const Vec3> position,
                                      const std::span<const double> nodal_weight, const double reach)
{
  const ElementSearch search(body, nodal_weight);
  const auto weight_at = [&](const ElementSearch::Found &at)
  {
    const auto nodes = body.element_nodes(at.element);
    double weight = 0.;
    for (unsigned int v = 0; v < 8; ++v)
      weight += trilinear().shape_value(v, at.unit) * nodal_weight[nodes[v]];
    return weight;
  };
  constexpr double whole = 1. - 1e-9;
  std::vector<Placed> placed;
  for (std::size_t i = 0; i < position.size(); ++i)
    if (const auto inside = search.find(position[i]))
      placed.push_back({i, *inside});
    else if (const auto at = search.find_near(position[i], reach); at && weight_at(*at) < whole)
      placed.push_back({i, *at});
  std::stable_sort(placed.begin(), placed.end(),
                   [](const Placed &a, const Placed &b) { return a.at.element < b.at.element; });
  return placed;
}

/// Gradients of the shape functions in space [1/m].
std::array<Vec3, 8> gradients_at(const Cell &cell, const dealii::Point<3> &unit)
{
  std::array<Vec3, 8> local;
  Eigen::Matrix3d jacobian = Eigen::Matrix3d::Zero(); // dx / d unit
  for (unsigned int v = 0; v < 8; ++v)
  {
    const auto gradient = trilinear().shape_grad(v, unit);
    const auto &x = cell->vertex(v);
    local[v] = {gradient[0], gradient[1], gradient[2]};
    jacobian += Vec3(x[0], x[1], x[2]) * local[v].transpose();
  }
  const Eigen::Matrix3d inverse_transposed = jacobian.inverse().transpose();
  for (Vec3 &gradient : local)
    gradient = inverse_transposed * gradient;
  return local;
}

/// Of a nodal field, three components a node.
Vec3 value_in(const fe::ExplicitBody &body, const ElementSearch::Found &at, const std::span<const double> field)
{
  const auto nodes = body.element_nodes(at.element);
  Vec3 value = Vec3::Zero();
  for (unsigned int v = 0; v < 8; ++v)
    value += trilinear().shape_value(v, at.unit) * Eigen::Map<const Vec3>(&field[3 * nodes[v]]);
  return value;
}

} // namespace

Overlap make_overlap(const fe::ExplicitBody &body, const std::span<const std::int64_t> id,
                     const std::span<const Vec3> position, const std::span<const double> volume,
                     const std::span<const double> nodal_weight, const double reach)
{
  if (nodal_weight.size() != body.n_nodes())
    reject("grains overlap a continuum of ", body.n_nodes(), " nodes, but ", nodal_weight.size(),
           " weights are given; give one per node");
  if (body.elements().nodes_per_element() != 8)
    throw ConfigError("grains overlap a continuum with elements of " +
                      std::to_string(body.elements().nodes_per_element()) +
                      " nodes; choose elements of degree 1, with 8 nodes");
  Overlap overlap;
  std::map<unsigned int, int> local_node; // node of the mesh -> place in overlap.nodes
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

  for (const auto &[i, at] : placed_by_element(body, position, nodal_weight, reach))
  {
    const auto nodes = body.element_nodes(at.element);
    const std::array<Vec3, 8> gradients = gradients_at(at.cell, at.unit);
    for (unsigned int v = 0; v < 8; ++v)
    {
      overlap.shape_gradient.push_back(gradients[v]);
      overlap.shape_node.push_back(place_of(nodes[v]));
      overlap.shape_value.push_back(std::clamp(trilinear().shape_value(v, at.unit), 0., 1.));
    }
    overlap.shape_offset.push_back(overlap.shape_node.size());
    overlap.particle_id.push_back(id[i]);
    overlap.particle_volume.push_back(volume[i]);
    const auto place = dealii::StaticMappingQ1<3>::mapping.transform_unit_to_real_cell(at.cell, at.unit);
    overlap.reference_position.emplace_back(place[0], place[1], place[2]);
  }
  if (overlap.nodes.empty())
    throw ConfigError("grains and continuum do not overlap: no grain's centre lies in an element; let the "
                      "elements reach into the grains by at least one layer");

  overlap.validate();
  return overlap;
}

std::vector<Vec3> reference_places(const fe::ExplicitBody &body, const std::span<const Vec3> position,
                                   const double reach)
{
  constexpr int n_iterations = 3; // each gains a factor of the displacement's gradient
  const ElementSearch search(body);
  const std::span<const double> u = body.displacement();
  std::vector<Vec3> places(position.begin(), position.end());
  for (std::size_t i = 0; i < places.size(); ++i)
    for (int k = 0; k < n_iterations; ++k)
    {
      const auto found = search.find_near(places[i], reach);
      if (!found)
        break;
      places[i] = position[i] - value_in(body, *found, u);
    }
  return places;
}

std::vector<Vec3> values_at(const fe::ExplicitBody &body, const std::span<const Vec3> position,
                            const std::span<const double> field)
{
  const ElementSearch search(body);
  std::vector<Vec3> values;
  for (const Vec3 &place : position)
  {
    const auto found = search.find(place);
    values.push_back(found ? value_in(body, *found, field) : Vec3::Zero());
  }
  return values;
}

std::vector<double> distances_to(const fe::ExplicitBody &body, const std::span<const Vec3> position)
{
  const ElementSearch search(body);
  const std::span<const double> u = body.displacement();
  double greatest = 0.;
  for (std::size_t dof = 0; dof < u.size(); dof += 3)
    greatest = std::max(greatest, Eigen::Map<const Vec3>(&u[dof]).norm());
  std::vector<double> distances;
  for (const Vec3 &place : position)
    distances.push_back(std::max(0., search.distance_to(place) - greatest));
  return distances;
}

} // namespace bergamo::coupling
