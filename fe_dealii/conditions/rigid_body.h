#pragma once

#include "fe_dealii/conditions/rigid_motion.h"

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace bergamo::fe
{

/// A rigid body without a mesh: its inertia, and the triangles of its surface.
struct RigidBodyShape
{
  RigidInertia inertia{};
  std::vector<std::array<double, 3>> vertices;        ///< at the start [m]
  std::vector<std::array<unsigned int, 3>> triangles; ///< of vertices, outward counterclockwise
  std::array<double, 3> gravity{};                    ///< [m/s²]
  RigidGuide guide{};                                 ///< motions that are not free

  /// Throws ConfigError: an inertia that no body has, a triangle of vertices that are none.
  void validate() const;
};

/// A pile, a plate or a projectile: moves by the leapfrog of RigidMotion, under gravity and what others exert on it.
/// One step, as a MovingBody's: clear_force(); others add; kick(dt); [read]; drift(dt). Steps may change in length.
class RigidBody
{
public:
  using Vector = std::array<double, 3>;

  explicit RigidBody(const RigidBodyShape &shape);

  void clear_force();
  /// @param force [N]; @param place where it acts, global [m]
  void add_force(const Vector &force, const Vector &place);
  void add_moment(const Vector &moment); ///< [N m]

  /// Errors as MovingBody::kick() and drift() have.
  /// @{
  void kick(double dt);
  void drift(double dt);
  /// @}

  std::size_t n_vertices() const { return arm_.size(); }
  Vector vertex(const std::size_t k) const { return motion_.place_of(arm_[k]); }             ///< present place [m]
  Vector vertex_velocity(const std::size_t k) const { return motion_.velocity_of(arm_[k]); } ///< [m/s]
  const std::vector<std::array<unsigned int, 3>> &triangles() const { return triangles_; }

  const RigidInertia &inertia() const { return motion_.inertia(); }        ///< at the start
  const Vector &centre() const { return motion_.motion().centre; }         ///< [m]
  Vector &velocity() { return motion_.motion().velocity; }                 ///< of the centre, half step [m/s]
  const Vector &velocity() const { return motion_.motion().velocity; }     ///< of the centre, half step [m/s]
  const Vector &angular_velocity() const { return motion_.motion().spin; } ///< half step [rad/s]
  void set_angular_velocity(const Vector &spin);                           ///< as it is now [rad/s]
  const Vector &angular_momentum() const { return motion_.motion().angular_momentum; }
  RigidGuide &guide() { return motion_.guide; }                         ///< may be changed between two steps
  const Vector &guide_force() const { return motion_.guide_force(); }   ///< in the last kick [N]
  const Vector &guide_moment() const { return motion_.guide_moment(); } ///< [N m]

  double kinetic_energy() const;             ///< at the last half step [J]
  double work() const { return kept_.work; } ///< of gravity and the guides up to the last kick, trapezoidal [J]

  /// What a restart needs, as views.
  std::vector<std::pair<std::string, std::span<double>>> state();

private:
  double power(const Vector &velocity, const Vector &spin) const; // of gravity and the guides [W]

  RigidMotion motion_;
  Vector gravity_;
  std::vector<Vector> arm_; // of the vertices, from the centre at the start
  std::vector<std::array<unsigned int, 3>> triangles_;
  Vector force_{}, moment_{};

  struct Kept // doubles only: it is part of the state
  {
    double last_step = 0; // dt of the last kick [s], 0 before the first
    double is_kicked = 0;
    double work = 0, work_ahead = 0;
  };
  Kept kept_;
};

} // namespace bergamo::fe
