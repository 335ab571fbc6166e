#pragma once

#include "coupling/arlequin/overlap.h"

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

namespace bergamo::coupling
{

/// How the outermost grains of an overlap are held.
struct EdgeParameters
{
  double depth = 1.5;      ///< of the edge, in mean diameters of the coupled grains (spheres of their volumes); 0: none
  double stiffness = 1e16; ///< per volume of grains [Pa/m^2], > 0

  /// Throws ConfigError.
  void validate() const;
};

/// The grains at the edge of an overlap, where their weight goes to zero. What lay beyond them is gone, and what the
/// coarse projection says of them is a mean over an element, about which they would loosen, and the grains above them.
/// So each of them is held by itself where the continuum is: a spring w V k (u_alpha - N^T u) to it, of the density k
/// of the stiffness, and a dead load instead of the contacts that are gone, with the opposite on the continuum at the
/// same point.
///
/// The edge are the grains nearer than the depth to where the weights of the nodes vanish, w < depth |grad w|.
class HeldEdge
{
public:
  HeldEdge() = default; ///< holds nothing

  /// @param node_weight of the coupling nodes in [0, 1]; @param particle_weight of the coupled particles, as in the run
  HeldEdge(const Overlap &overlap, std::span<const double> node_weight, std::span<const double> particle_weight,
           const EdgeParameters &parameters);

  std::size_t size() const { return particle_.size(); }
  std::span<const int> particles() const { return particle_; } ///< places in the Overlap, ascending

  /// The dead load of a held particle [N], in the order of particles(); zero at first.
  std::vector<Eigen::Vector3d> dead_load;

  /// Add the forces on the held particles to `force`. @param difference u_alpha - N^T u of all coupled particles [m]
  /// @return their energy [J] @{
  double add_springs(std::span<const Eigen::Vector3d> difference, std::span<Eigen::Vector3d> force) const;
  double add_dead_loads(std::span<const Eigen::Vector3d> difference, std::span<Eigen::Vector3d> force) const;
  /// @}

private:
  std::vector<int> particle_;
  std::vector<double> stiffness_; // [N/m]
};

} // namespace bergamo::coupling
