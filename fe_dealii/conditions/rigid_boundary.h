#pragma once

#include "fe_dealii/conditions/rigid_motion.h"
#include "fe_dealii/moving_body.h"

#include <array>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace bergamo::fe
{

/// A rigid body that is free to move: mass and inertia without the nodes' own share.
struct RigidBodyParameters
{
  double mass = 0;                 ///< >= 0 [kg]
  std::array<double, 3> centre{};  ///< centre of mass at the start, beside the nodes' present places [m]
  std::array<double, 3> inertia{}; ///< about the global axes through the centre, no products; >= 0 [kg m²]
  RigidGuide guide{};              ///< motions that are not free

  /// Throws ConfigError.
  void validate() const;
};

/// Nodes of a body that move as one rigid body: a footing, a pile's head, a plate. Either its velocities are
/// prescribed, or it moves freely under its own weight, what the continuum and others exert on its nodes, and a force
/// and moment of the user's. Nodes keep their distances to rounding at any rotation, those that they have when it is
/// set up. Elements whose nodes are all its own are rigid, see MovingBody::make_rigid().
class RigidBoundary
{
public:
  using Vector = std::array<double, 3>;

  /// Takes all components of the nodes. Throws ConfigError for bad parameters, no nodes, or nodes of which a
  /// component is prescribed already.
  RigidBoundary(MovingBody &body, std::span<const unsigned int> nodes, const RigidBodyParameters &parameters);

  /// To be called in every step, between compute_internal_force() and the body's kick(); called again in the same step
  /// it begins anew. @param dt of the step to come [s]; ConfigError unless it is positive and finite
  /// @{

  /// Moves on with prescribed velocities. @param velocity of the centre [m/s]; @param angular_velocity [rad/s]
  void prescribe(const Vector &velocity, const Vector &angular_velocity, double dt);

  /// Moves on freely. @param force on the centre [N]; @param moment about it [N m]; both beside weight and nodes
  void move(const Vector &force, const Vector &moment, double dt);
  /// @}

  /// Resultant of the continuum, its weight and the external forces on the nodes at the last call, and its moment about
  /// the centre [N, N m].
  const Vector &force() const { return force_; }
  const Vector &moment() const { return moment_; }

  const Vector &centre() const { return present().centre; } ///< present; of the rigid body and the nodes together [m]
  const Vector &velocity() const { return next_.motion().velocity; }     ///< of the centre, at half steps [m/s]
  const Vector &angular_velocity() const { return next_.motion().spin; } ///< at half steps [rad/s]
  double mass() const { return next_.inertia().mass; } ///< of the rigid body and the nodes together [kg]
  double kinetic_energy() const;                       ///< without the nodes, at the last half step [J]
  double angle() const { return next_.angle(); }       ///< by which it will have turned after the last call [rad]

  /// Motions that are not free in move(); may be changed between two steps.
  RigidGuide &guide() { return next_.guide; }
  const Vector &guide_force() const { return next_.guide_force(); }   ///< in the last move() [N]
  const Vector &guide_moment() const { return next_.guide_moment(); } ///< about the centre [N m]

  /// What a restart needs, as views.
  std::vector<std::pair<std::string, std::span<double>>> state();

private:
  void begin(double dt);
  void gather_forces();
  void advance(double dt);

  MovingBody &body;
  RigidBodyParameters parameters;
  std::vector<unsigned int> nodes;
  std::vector<MovingBody::Constraint> constraints; // three a node
  std::vector<Vector> arm;                         // from the centre, at the start
  Vector own_centre{};                             // of the rigid body alone, from the centre, at the start
  Vector force_{}, moment_{};
  RigidMotion::Motion now; // at the step of the last call
  RigidMotion next_;       // after the step to come
  double step_of_next = 0; // number of the step that leads there

  /// The body's drift has brought the nodes to where the last call sent them, or not yet.
  const RigidMotion::Motion &present() const { return body.n_steps() < step_of_next ? now : next_.motion(); }
};

} // namespace bergamo::fe
