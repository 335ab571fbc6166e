#include "dem/state/surface.h"

#include "dem/core/error.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace bergamo::dem
{
namespace
{

std::array<Vec3, 3> corners(const std::vector<Vec3> &values, const Triangle &t)
{
  return {values[t[0]], values[t[1]], values[t[2]]};
}

} // namespace

Surface::Surface(std::vector<Vec3> nodes, std::vector<Triangle> triangles)
    : topology(std::move(triangles), nodes.size()), node(std::move(nodes))
{
}

FacePlane<double> Surface::plane_of(const Triangle &t) const
{
  return FacePlane<double>(corners(node, t));
}

FeatureField<double> Surface::field_of(const FeatureOfSurface &f) const
{
  const Triangle &t = topology.triangle[face_of(f)];
  FeatureField<double> field = plane_of(t).field(corners(node, t), corners(drift_velocity, t));
  if (f.feature == Feature::face)
    return field;
  const std::int32_t first = f.feature == Feature::edge ? topology.edge[f.number].from : f.number;
  field.node = node[first];
  field.velocity = drift_velocity[first];
  field.gradient = -Mat3::Identity().colwise().cross(field.spin);
  if (f.feature == Feature::edge)
  {
    const std::int32_t last = topology.edge[f.number].to;
    const Vec3 along = node[last] - node[first], stretching = drift_velocity[last] - drift_velocity[first];
    field.gradient += (stretching - field.spin.cross(along)) * (along / along.squaredNorm()).transpose();
  }
  return field;
}

/// The transpose of field_of(): beside a face by the shares of the feature's nodes, and by the moment about the point
/// straight below.
void Surface::add_force(const FeatureOfSurface &f, const Vec3 &point, const Vec3 &force,
                        const std::span<Vec3> forces) const
{
  const Triangle &t = topology.triangle[face_of(f)];
  const FacePlane<double> plane = plane_of(t);
  const auto add = [&](const std::array<Vec3, 3> &on_corners)
  {
    for (int k = 0; k < 3; ++k)
      forces[t[k]] += on_corners[k];
  };
  if (f.feature == Feature::face)
    return add(plane.forces(point - node[t[0]], force));
  const NodeShares shares = node_shares(*this, f.feature, f.number, point);
  for (int k = 0; k < 3; ++k)
    forces[shares.node[k]] += shares.share[k] * force;
  const Vec3 moment = (point - shares.of(node)).cross(force), tilting = plane.normal.cross(moment);
  const auto turned_by = [&](const Vec3 &gradient) -> Vec3
  { return tilting.dot(gradient) * plane.normal + 0.5 * moment.dot(plane.normal) * plane.normal.cross(gradient); };
  const Vec3 on_second = turned_by(plane.of_second), on_third = turned_by(plane.of_third);
  add({-on_second - on_third, on_second, on_third});
}

Vec3 Surface::direction_of_edge(const std::int32_t e) const
{
  return (node[topology.edge[e].to] - node[topology.edge[e].from]).normalized();
}

std::int32_t Surface::face_of(const FeatureOfSurface &f) const
{
  switch (f.feature)
  {
  case Feature::face:
    return f.number;
  case Feature::edge:
    return topology.edge[f.number].left;
  default:
    return topology.corners_of(f.number)[0].face;
  }
}

void Surface::advance(const double time_step)
{
  drift_velocity = velocity;
  double fastest = 0.;
  for (std::size_t n = 0; n < drift_velocity.size(); ++n)
  {
    node[n] += time_step * velocity[n];
    fastest = std::max(fastest, velocity[n].squaredNorm());
  }
  if (fastest == 0.)
    drift_velocity.clear();
  motion += time_step * std::sqrt(fastest);
  if (!keeps_forces())
    force.clear(); // should it move again, these were not those of the step before
}

void Surface::move_to(const std::span<const Vec3> places, const double time_step)
{
  require(places.size() == node.size(), "number of places of a surface's nodes", places.size(),
          "that of its nodes, " + std::to_string(node.size()));
  if (drift_velocity.empty())
    drift_velocity.assign(node.size(), Vec3::Zero());
  double furthest = 0.;
  for (std::size_t n = 0; n < node.size(); ++n)
  {
    const Vec3 way = places[n] - node[n];
    node[n] = places[n];
    drift_velocity[n] += way / time_step;
    furthest = std::max(furthest, way.squaredNorm());
  }
  motion += std::sqrt(furthest);
}

void Surface::take_forces(std::vector<Vec3> forces, const double time_step)
{
  const std::vector<Vec3> old = std::exchange(force, std::move(forces));
  if (old.size() == drift_velocity.size()) // else it has not moved
    for (std::size_t n = 0; n < old.size(); ++n)
      work -= 0.5 * time_step * (old[n] + force[n]).dot(drift_velocity[n]);
}

void Surface::validate(const std::int32_t n_materials) const
{
  require(topology.n_faces() > 0, "number of triangles of a surface", 0, "at least 1");
  for (const auto *values : {&node, &force, &velocity, &drift_velocity})
  {
    require(values->size() == topology.n_nodes() || (values != &node && values->empty()),
            "number of places, velocities or forces of a surface's nodes", values->size(),
            "that of its nodes, " + std::to_string(topology.n_nodes()));
    for (const Vec3 &value : *values)
      require(value.allFinite(), "place, velocity or force of a surface's node", value.sum(), "finite");
  }
  require(offset >= 0. && std::isfinite(offset), "offset of a surface", offset, "zero or a positive number of metres");
  for (std::size_t f = 0; f < topology.n_faces(); ++f)
  {
    const Triangle &t = topology.triangle[f];
    const Vec3 a = node[t[1]] - node[t[0]], b = node[t[2]] - node[t[0]];
    if (!(a.cross(b).norm() > 1e-12 * std::max(a.squaredNorm(), b.squaredNorm())))
      reject_triangle(f, "triangle ", f, " of a surface (nodes ", t[0], ", ", t[1], ", ", t[2],
                      ") has no area: remove it, and let its neighbours meet");
  }
  require(material >= 0 && material < n_materials, "material of a surface", material,
          "the number of one of the " + std::to_string(n_materials) + " materials of the table, counted from 0");
}

std::vector<std::int32_t> Surface::numbers() const
{
  std::vector<std::int32_t> numbers;
  for (const Triangle &t : topology.triangle)
    numbers.insert(numbers.end(), t.begin(), t.end());
  return numbers;
}

void Surface::restore(const std::vector<std::int32_t> &numbers)
{
  std::vector<Triangle> triangles(numbers.size() / 3);
  for (std::size_t k = 0; k < numbers.size(); ++k)
    triangles[k / 3][k % 3] = numbers[k];
  topology = SurfaceTopology(std::move(triangles), node.size());
}

FeatureOfSurface feature_of(const std::span<const Surface> surfaces, std::int32_t count)
{
  for (std::size_t s = 0; s < surfaces.size(); ++s)
  {
    const SurfaceTopology &t = surfaces[s].topology;
    const auto surface = static_cast<std::int32_t>(s);
    for (const auto &[feature, n] : {std::pair(Feature::face, t.n_faces()), std::pair(Feature::edge, t.n_edges()),
                                     std::pair(Feature::vertex, t.n_nodes())})
    {
      if (count < static_cast<std::int32_t>(n))
        return {surface, feature, count};
      count -= static_cast<std::int32_t>(n);
    }
  }
  return {-1, Feature::face, -1};
}

NodeShares node_shares(const Surface &surface, const Feature feature, const std::int32_t number, const Vec3 &point)
{
  if (feature == Feature::vertex)
    return {{number, number, number}, {1., 0., 0.}};
  if (feature == Feature::edge)
  {
    const SurfaceTopology::Edge &e = surface.topology.edge[number];
    const Vec3 along = surface.node[e.to] - surface.node[e.from];
    const double share = along.dot(point - surface.node[e.from]) / along.squaredNorm();
    return {{e.from, e.to, e.from}, {1. - share, share, 0.}};
  }
  const Triangle &t = surface.topology.triangle[number];
  const Vec3 a = surface.node[t[1]] - surface.node[t[0]], b = surface.node[t[2]] - surface.node[t[0]],
             p = point - surface.node[t[0]], normal = a.cross(b);
  const double area = normal.squaredNorm();
  const double of_a = p.cross(b).dot(normal) / area, of_b = a.cross(p).dot(normal) / area;
  return {t, {1. - of_a - of_b, of_a, of_b}};
}

} // namespace bergamo::dem
