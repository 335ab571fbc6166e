#pragma once

#include "coupling/arlequin/element_blocks.h"

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
  /// Of the springs, over what the gradient of the weights takes from the grain, beside its dead load; 0: any force.
  double strength = 0.6;

  /// Throws ConfigError.
  void validate() const;
};

/// The grains at the edge of an overlap, where their weight goes to zero. What lay beyond them is gone, and what the
/// coarse projection says of them is a mean over an element, about which they would loosen, and the grains above them.
/// So each of them is held by itself where the continuum is: a spring w V k (u_alpha - N^T u) to it, of the density k
/// of the stiffness, and a dead load instead of the contacts that are gone, with the opposite on the continuum at the
/// same point. Neighbours let a grain slide where it is pulled too far, and so does a spring with a strength.
///
/// The edge are the grains nearer than the depth to where the weights of the nodes vanish, w < depth |grad w|. It stays
/// tied to the points of the continuum where it was made, whatever becomes of the overlap.
class HeldEdge
{
public:
  HeldEdge() = default; ///< holds nothing

  /// @param node_weight of the coupling nodes in [0, 1]; @param particle_weight of the coupled particles, as in the run
  HeldEdge(const Overlap &overlap, std::span<const double> node_weight, std::span<const double> particle_weight,
           const EdgeParameters &parameters);

  std::size_t size() const { return particle_.size(); }
  std::span<const std::int32_t> particles() const { return particle_; } ///< places in the Overlap

  /// The dead load of a held particle [N], in the order of particles(); zero at first.
  std::vector<Eigen::Vector3d> dead_load;

  /// Largest force of a spring [N], beyond which it slips, in the order of particles(). Empty where none slips: at
  /// first, and when the particles have become others. No part of the state.
  std::vector<double> strength;

  /// What slips of the springs have taken from both models so far [J].
  double slip_loss() const { return slip_loss_; }

  enum class Loads
  {
    all,
    springs
  };

  /// Its forces on both models, as PenaltyCoupling::compute() has them, particles in the order of particles() [N]:
  /// `particle_force` is overwritten, `fe_force` is added to. @return their energy [J]
  /// @throws ConfigError for loads or strengths of another number of particles
  double add_forces(std::span<const Eigen::Vector3d> particle_displacement, std::span<const double> fe_displacement,
                    std::span<Eigen::Vector3d> particle_force, std::span<double> fe_force, Loads loads);

  /// Follows its particles into another overlap, see PenaltyCoupling::renew(); those that are in it no more are let go.
  /// @return the energy that these had at the last add_forces() [J]
  double renew(const Overlap &overlap, std::span<const Eigen::Vector3d> moved);

  /// Becomes another edge of the same overlap. Particles that are held by both stay tied as they were, the others are
  /// let go; places of those that are new are appended to `fresh`, in the order of particles().
  /// @return the energy that those let go had at the last add_forces() [J]
  double become(HeldEdge other, std::vector<std::size_t> &fresh);

  /// All of it, by name; see dem/core/state.h.
  template <class Self, class Visit>
  static void visit_state(Self &self, Visit &visit)
  {
    visit("id", self.id_);
    visit("particle", self.particle_);
    visit("stiffness", self.stiffness_);
    visit("node", self.node_);
    visit("place", self.place_);
    visit("shift", self.shift_);
    visit("dead_load", self.dead_load);
    visit("stretch", self.stretch_);
    visit("slip_loss", self.slip_loss_);
  }

private:
  static constexpr std::size_t n_nodes = 8; // of an element

  std::size_t end_of_element(std::size_t k) const;
  void remove(const std::vector<bool> &is_gone);
  void slip(std::size_t k, Eigen::Vector3d &stretch);
  void copy(std::size_t from, const HeldEdge &other, std::size_t to);

  std::vector<std::int64_t> id_;
  std::vector<std::int32_t> particle_;
  std::vector<double> stiffness_;        // [N/m]
  std::vector<std::int32_t> node_;       // of the mesh, 8 a particle
  std::vector<Eigen::Vector3d> place_;   // in their element, in local coordinates
  std::vector<Eigen::Vector3d> shift_;   // of the places from which displacements count since the edge was made [m]
  std::vector<Eigen::Vector3d> stretch_; // of the springs at the last add_forces() with all loads [m]
  std::vector<double> energy_;           // at the last add_forces() [J]
  double slip_loss_ = 0.;                // [J]
};

} // namespace bergamo::coupling
