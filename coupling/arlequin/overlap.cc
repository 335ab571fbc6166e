#include "coupling/arlequin/overlap.h"

#include "dem/core/error.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>
#include <unordered_set>

namespace bergamo::coupling
{

namespace
{

constexpr double shape_tolerance = 1e-8;    ///< of values that should be 0, 1 or sum to 1
constexpr double position_tolerance = 1e-6; ///< of a particle's position, over the extent of its nodes

template <class... Parts>
[[noreturn]] void fail(const Parts &...parts)
{
  reject("overlap of grains and elements: ", parts...);
}

std::string text(const Eigen::Vector3d &position)
{
  std::ostringstream stream;
  stream << "(" << position.x() << ", " << position.y() << ", " << position.z() << ") m";
  return stream.str();
}

/// On which side a node of an element lies along a local coordinate.
double side(const int corner, const int axis)
{
  return (corner >> axis & 1) != 0 ? 1. : -1.;
}

void check_sizes(const Overlap &overlap)
{
  const std::size_t n_nodes = overlap.n_nodes(), n_particles = overlap.n_particles();
  if (n_nodes == 0 || n_particles == 0)
    fail("it has ", n_nodes, " nodes and ", n_particles, " particles; place it where both models are");
  if (overlap.node_position.size() != n_nodes)
    fail(overlap.node_position.size(), " node positions for ", n_nodes, " nodes");
  if (overlap.particle_volume.size() != n_particles || overlap.reference_position.size() != n_particles)
    fail(overlap.particle_volume.size(), " volumes and ", overlap.reference_position.size(), " positions for ",
         n_particles, " particles");
  if (overlap.shape_offset.size() != n_particles + 1 || overlap.shape_offset.front() != 0 ||
      !std::is_sorted(overlap.shape_offset.begin(), overlap.shape_offset.end()) ||
      overlap.shape_offset.back() != overlap.shape_node.size() ||
      overlap.shape_node.size() != overlap.shape_value.size() ||
      overlap.shape_node.size() != overlap.shape_gradient.size())
    fail("the shape function values are not in rows of particles");
  for (std::size_t particle = 0; particle < n_particles; ++particle)
    if (const std::size_t n = overlap.shape_offset[particle + 1] - overlap.shape_offset[particle]; n != 8)
      fail("particle ", overlap.particle_id[particle], " has ", n,
           " shape function values; take elements of degree 1, with 8 nodes");
  const auto is_node = [n_nodes](const int node) { return node >= 0 && static_cast<std::size_t>(node) < n_nodes; };
  if (!std::all_of(overlap.shape_node.begin(), overlap.shape_node.end(), is_node))
    fail("a shape function value names a node outside the ", n_nodes, " coupling nodes");
}

void check_particle(const Overlap &overlap, const std::size_t particle)
{
  const auto name = [&]
  {
    return "particle " + std::to_string(overlap.particle_id[particle]) + " at " +
           text(overlap.reference_position[particle]);
  };
  if (!(overlap.particle_volume[particle] > 0.) || !std::isfinite(overlap.particle_volume[particle]))
    fail(name(), " has the volume ", overlap.particle_volume[particle], " m^3; volumes must be positive");

  double sum = 0., extent = 0.;
  Eigen::Vector3d interpolated = Eigen::Vector3d::Zero();
  Eigen::Matrix3d gradient = Eigen::Matrix3d::Zero();
  const Eigen::Vector3d &position = overlap.reference_position[particle];
  for (std::size_t k = overlap.shape_offset[particle]; k < overlap.shape_offset[particle + 1]; ++k)
  {
    const double value = overlap.shape_value[k];
    const Eigen::Vector3d &node = overlap.node_position[overlap.shape_node[k]];
    if (!(value >= -shape_tolerance && value <= 1. + shape_tolerance))
      fail(name(), " has the shape function value ", value,
           "; values must lie in [0, 1]: look for its element again and take linear elements");
    sum += value;
    interpolated += value * node;
    gradient += (node - position) * overlap.shape_gradient[k].transpose();
    extent = std::max(extent, (node - position).norm());
  }
  if (!(std::abs(sum - 1.) <= shape_tolerance))
    fail("the shape function values of ", name(), " sum to ", sum, " instead of 1; look for its element again");
  const Eigen::Vector3d local = overlap.local_place(particle);
  for (int corner = 0; corner < 8; ++corner)
  {
    double value = 0.125;
    for (int axis = 0; axis < 3; ++axis)
      value *= 1. + side(corner, axis) * local[axis];
    if (!(std::abs(overlap.shape_value[overlap.shape_offset[particle] + corner] - value) <= shape_tolerance))
      fail("the shape function values of ", name(),
           " are not those of a trilinear element; give its nodes along each coordinate in turn");
  }
  if (!((interpolated - position).norm() <= position_tolerance * extent))
    fail("the shape function values of ", name(), " belong to the place ", text(interpolated),
         "; look for its element again");
  if (!((gradient - Eigen::Matrix3d::Identity()).norm() <= position_tolerance))
    fail("the shape function gradients of ", name(), " are not those of its place; look for its element again");
}

void check_nodes(const Overlap &overlap)
{
  const std::size_t n_nodes = overlap.n_nodes();
  std::unordered_set<int> seen;
  for (std::size_t node = 0; node < n_nodes; ++node)
    if (overlap.nodes[node] < 0 || !seen.insert(overlap.nodes[node]).second)
      fail("the node at ", text(overlap.node_position[node]), " is number ", overlap.nodes[node],
           "; numbers must be 0 or more, each once");
}

} // namespace

double mean_diameter(const std::span<const double> volume)
{
  double sum = 0.;
  for (const double one : volume)
    sum += std::cbrt(6. * one / std::numbers::pi);
  return sum / static_cast<double>(volume.size());
}

Eigen::Vector3d Overlap::local_place(const std::size_t particle) const
{
  Eigen::Vector3d place = Eigen::Vector3d::Zero();
  for (int corner = 0; corner < 8; ++corner)
    for (int axis = 0; axis < 3; ++axis)
      place[axis] += side(corner, axis) * shape_value[shape_offset[particle] + corner];
  return place;
}

void Overlap::validate() const
{
  check_sizes(*this);
  for (std::size_t particle = 0; particle < n_particles(); ++particle)
    check_particle(*this, particle);
  check_nodes(*this);
}

} // namespace bergamo::coupling
