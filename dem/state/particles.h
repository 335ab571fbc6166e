#pragma once

#include "dem/core/types.h"
#include "dem/state/parts.h"
#include "dem/state/periodic_cell.h"

#include <cmath>
#include <cstdint>
#include <vector>

namespace bergamo::dem
{

class Clump;

/// Rigid bodies as a structure of arrays, all of length size(), and the parts that are their shapes. Global frame, SI
/// units. Velocity and angular momentum belong to half steps (leapfrog), everything else to whole steps.
struct Particles
{
  std::vector<std::int64_t> id;        ///< identity that survives every sort
  std::vector<double> mass;            ///< [kg]
  std::vector<double> volume;          ///< of the solid [m^3]
  std::vector<Vec3> inertia;           ///< principal moments in the body frame [kg m^2]
  std::vector<double> bounding_radius; ///< about the centre, all parts included [m]

  std::vector<Vec3> position;          ///< centre of mass [m]
  std::vector<Quaternion> orientation; ///< body to global
  std::vector<Vec3> velocity;          ///< at the half step before; may be set between steps [m/s]
  std::vector<Vec3> angular_momentum;  ///< global frame; likewise [kg m^2/s]
  std::vector<Vec3> drift_velocity;    ///< mean over the step before, which led to the present place [m/s]
  std::vector<Vec3> angular_velocity;  ///< mean over the step before, which led to the present orientation [1/s]
  std::vector<double> turned;          ///< sum of the angles of all turns since the start [rad]

  std::vector<Vec3> force;          ///< resultant at this step [N]
  std::vector<Vec3> torque;         ///< about the centre [N m]
  std::vector<Vec3> external_force; ///< added to the contact forces, e.g. by a coupling [N]; empty where there is none

  std::vector<Vec3> external_torque; ///< likewise, about the centre [N m]; empty where there is none

  /// Share w in (0, 1] of this particle in the virtual work: 1 unless another model shares the particle's place.
  /// Mass, inertia and body forces count w times; a contact counts with the weight w_c at its point.
  std::vector<double> weight;

  /// @name What contacts would give this particle with its own weight, beyond what they give with theirs
  /// Sums over the contacts of (w - w_c) f: what the gradient of the weights takes from the particle. Whoever shares
  /// its place may give it back and keep the opposite, see coupling/arlequin/weight_transfer.h. Empty where all weights
  /// are 1.
  /// @{
  std::vector<Vec3> transfer_force;  ///< [N]
  std::vector<Vec3> transfer_torque; ///< about the centre [N m]
  bool are_weighted() const { return !transfer_force.empty(); }
  void look_at_weights(); ///< makes these arrays, or clears them, as the weights ask for
  /// @}

  double largest_motion = 0.; ///< sum over the steps of the largest growth of any part's motion [m]

  Parts parts;
  std::vector<std::int32_t> first_part{0}; ///< parts of particle i: first_part[i] .. first_part[i + 1]

  PeriodicCell cell; ///< in which the particles repeat themselves, if any

  /// From the centre of particle i to the centre of an image of particle j [m].
  Vec3 branch(const std::int32_t i, const std::int32_t j, const Image image) const
  {
    return position[j] - position[i] + cell.place[image];
  }

  std::size_t size() const { return position.size(); }

  /// Whether any particle has more than one part; the only part of a particle lies at its centre, unturned.
  bool has_clumps() const { return parts.size() != size(); }

  Vec3 part_position(const std::size_t k) const ///< centre of a part [m]
  {
    const std::int32_t i = parts.particle[k];
    return position[i] + orientation[i] * parts.place[k];
  }
  Quaternion part_orientation(const std::size_t k) const { return orientation[parts.particle[k]] * parts.turn[k]; }

  /// Adds a grain at rest, of one part. Mass, inertia and bounding radius follow from shape and density [kg/m^3].
  /// Throws ConfigError as check() does.
  void add(const Superquadric &shape, double density, const Vec3 &position, const Quaternion &orientation,
           std::int32_t material = 0);

  /// Adds a clump at rest. @param position of its centre of mass [m]; @param orientation of its principal frame to the
  /// global one; @param material of all its parts. Throws ConfigError as check() does.
  void add(const Clump &clump, double density, const Vec3 &position, const Quaternion &orientation,
           std::int32_t material = 0);

  /// Adds particle i of others, with all its parts, under a new id.
  void append(const Particles &others, std::size_t i, std::int64_t new_id);

  /// Holds a particle where it is: a part of a rough wall, of infinite mass and inertia. Two such feel no contact.
  void fix(std::size_t i);
  bool is_fixed(const std::size_t i) const { return std::isinf(mass[i]); }

  /// Throws ConfigError naming particle, value and remedy where arrays differ in length or a number is out of range:
  /// shapes, mass and inertia, weights, poses, velocities. @param n_materials of the simulation's table
  void check(std::int32_t n_materials) const;

  /// Takes the order of the particles, order[new] = old, and of their parts with them.
  /// @return order of the parts, likewise
  std::vector<std::int32_t> reorder(const std::vector<std::int32_t> &order);

  /// Whether an array is empty where a simulation has no use for it.
  static bool is_optional(const std::string &name)
  {
    return name == "external_force" || name == "external_torque" || name == "transfer_force" ||
           name == "transfer_torque";
  }

  /// Every array of the particles with its name, parts excepted: sorting, snapshot and hash follow from this list.
  template <class Self, class Visit>
  static void visit_fields(Self &self, Visit &&visit)
  {
    visit("id", self.id);
    visit("mass", self.mass);
    visit("volume", self.volume);
    visit("inertia", self.inertia);
    visit("bounding_radius", self.bounding_radius);
    visit("position", self.position);
    visit("orientation", self.orientation);
    visit("velocity", self.velocity);
    visit("angular_momentum", self.angular_momentum);
    visit("drift_velocity", self.drift_velocity);
    visit("angular_velocity", self.angular_velocity);
    visit("turned", self.turned);
    visit("force", self.force);
    visit("torque", self.torque);
    visit("external_force", self.external_force);
    visit("external_torque", self.external_torque);
    visit("weight", self.weight);
    visit("transfer_force", self.transfer_force);
    visit("transfer_torque", self.transfer_torque);
  }

  template <class Self, class Visit>
  static void visit_state(Self &self, Visit &visit)
  {
    visit_fields(self, visit);
    visit("parts", self.parts);
    visit("first_part", self.first_part);
    visit("largest_motion", self.largest_motion);
    visit("cell", self.cell);
  }
};

} // namespace bergamo::dem
