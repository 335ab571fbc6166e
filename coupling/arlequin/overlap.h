#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

namespace bergamo::coupling
{

/// Mean diameter of spheres of these volumes [m].
double mean_diameter(std::span<const double> volume);

/// The region where grains and elements share the space, in the reference configuration (Wellmann, 6.1 and 6.3).
/// A coupling node is a node of an element of the overlap; within this room nodes are known by their place in
/// `nodes`. A coupled particle is one whose centre lies in an element of the overlap, an element of the overlap one
/// that holds a centre.
struct Overlap
{
  std::vector<int> nodes;                     ///< number of each coupling node in the FE mesh, each once
  std::vector<Eigen::Vector3d> node_position; ///< reference position [m]

  std::vector<std::int64_t> particle_id;           ///< identity of each coupled particle
  std::vector<double> particle_volume;             ///< V_alpha [m^3]
  std::vector<Eigen::Vector3d> reference_position; ///< centre of each coupled particle [m]

  /// Values N_I(x_alpha) of the shape functions at the centres, particle by particle: those of particle alpha stand at
  /// [shape_offset[alpha], shape_offset[alpha + 1]), 8 of a trilinear hexahedron. Bits 1, 2, 4 of a node's place among
  /// them say on which side it lies along each local coordinate.
  std::vector<std::size_t> shape_offset{0};
  std::vector<int> shape_node; ///< place of the node in `nodes`
  std::vector<double> shape_value;
  std::vector<Eigen::Vector3d> shape_gradient; ///< of N_I at the centre [1/m]

  std::size_t n_nodes() const { return nodes.size(); }
  std::size_t n_particles() const { return particle_id.size(); }
  double mean_diameter() const { return coupling::mean_diameter(particle_volume); } ///< [m]

  /// Local coordinates of a particle in its element, in [-1, 1], of which all shape values follow.
  Eigen::Vector3d local_place(std::size_t particle) const;

  /// Throws ConfigError, naming the particle or the position of the node and the remedy, unless sizes fit,
  /// every particle has 8 shape values of a trilinear element that sum to 1 and give back its position, their
  /// gradients give back the gradient of the position, and nodes are named once. Elements may be filled only in part.
  void validate() const;
};

} // namespace bergamo::coupling
