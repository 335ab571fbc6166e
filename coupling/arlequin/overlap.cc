#include "coupling/arlequin/overlap.h"

#include "dem/core/error.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <unordered_set>

namespace bergamo::coupling
{

namespace
{

constexpr double shape_tolerance = 1e-8;    ///< of values that should be 0, 1 or sum to 1
constexpr double position_tolerance = 1e-6; ///< of a particle's position, over the extent of its nodes
constexpr double least_reach = 1e-6;        ///< shape value from which a particle counts as reaching a node

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
  const auto is_node = [n_nodes](const int node) { return node >= 0 && static_cast<std::size_t>(node) < n_nodes; };
  if (!std::all_of(overlap.shape_node.begin(), overlap.shape_node.end(), is_node))
    fail("a shape function value names a node outside the ", n_nodes, " coupling nodes");
  if (static_cast<std::size_t>(overlap.volume_matrix.rows()) != n_nodes ||
      static_cast<std::size_t>(overlap.volume_matrix.cols()) != n_nodes)
    fail("the volume matrix is ", overlap.volume_matrix.rows(), " x ", overlap.volume_matrix.cols(), " for ", n_nodes,
         " nodes");
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

  std::vector<double> reach(n_nodes, 0.);
  for (std::size_t k = 0; k < overlap.shape_node.size(); ++k)
    reach[overlap.shape_node[k]] = std::max(reach[overlap.shape_node[k]], overlap.shape_value[k]);
  for (std::size_t node = 0; node < n_nodes; ++node)
    if (reach[node] < least_reach)
      fail("no particle reaches the node at ", text(overlap.node_position[node]),
           "; its elements must be filled with particles: take larger elements or smaller grains");
}

void check_volume_matrix(const Overlap &overlap)
{
  const auto &matrix = overlap.volume_matrix;
  const Eigen::SparseMatrix<double, Eigen::RowMajor> transposed = matrix.transpose();
  const double largest = matrix.nonZeros() > 0 ? matrix.coeffs().abs().maxCoeff() : 0.;
  if (!std::isfinite(largest))
    fail("the volume matrix has an entry that is no number");
  if ((matrix - transposed).norm() > 1e-12 * matrix.norm())
    fail("the volume matrix is not symmetric");
  const Eigen::VectorXd row_sums = matrix * Eigen::VectorXd::Ones(matrix.cols());
  for (Eigen::Index node = 0; node < row_sums.size(); ++node)
    if (!(row_sums[node] > 0.))
      fail("the node at ", text(overlap.node_position[node]), " has the volume ", row_sums[node],
           " m^3; integrate over all elements of the overlap");
}

} // namespace

void Overlap::validate() const
{
  check_sizes(*this);
  for (std::size_t particle = 0; particle < n_particles(); ++particle)
    check_particle(*this, particle);
  check_nodes(*this);
  check_volume_matrix(*this);
}

} // namespace bergamo::coupling
