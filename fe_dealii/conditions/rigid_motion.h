#pragma once

#include <array>
#include <optional>
#include <span>

namespace bergamo::fe
{

/// Motions of a rigid body that are not free, along and about the global axes: a number is the velocity [m/s] or the
/// angular velocity [rad/s] that is kept, 0 for a guide.
struct RigidGuide
{
  std::array<std::optional<double>, 3> velocity{}, angular_velocity{};
};

/// A rigid body's inertia at the start of its motion.
struct RigidInertia
{
  double mass = 0;                ///< [kg]
  std::array<double, 3> centre{}; ///< of mass [m]
  double inertia[3][3] = {};      ///< about the centre, global axes; symmetric [kg m²]

  /// Adds that of a point. @param mass [kg]; @param arm from the centre [m]
  void add_point(double mass, const std::array<double, 3> &arm);
};

/// The leapfrog of a rigid body: places at whole steps, velocities at half steps, angular momentum in the global frame;
/// second order at any rotation. Everything that a restart needs is in Motion.
class RigidMotion
{
public:
  using Vector = std::array<double, 3>;

  struct Motion // doubles only: it is the state
  {
    Vector centre{}, velocity{}, spin{}, angular_momentum{};
    double rotation[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  };

  explicit RigidMotion(const RigidInertia &inertia) : inertia_(inertia) { motion_.centre = inertia.centre; }

  /// From v⁻ to v⁺. @param force on the centre [N]; @param moment about it [N m]; @param time over which they act [s];
  /// @param step to come [s], whose middle sets the orientation in which angular momentum becomes a spin
  /// Throws RunError where they are not finite, ConfigError for a free motion without mass or inertia.
  void kick(const Vector &force, const Vector &moment, double time, double step);
  /// The same with velocities that are given.
  void prescribe(const Vector &velocity, const Vector &angular_velocity, double step);
  void drift(double step);

  /// Where a point that was at an arm from the centre at the start is now [m].
  Vector place_of(const Vector &arm) const;
  /// Its velocity in the present orientation [m/s].
  Vector velocity_of(const Vector &arm) const;
  double angle() const; ///< by which the body has turned [rad], in [0, π]

  const RigidInertia &inertia() const { return inertia_; }
  const Motion &motion() const { return motion_; }
  Motion &motion() { return motion_; }
  RigidGuide guide;

  /// What the guides exerted in the last kick() [N, N m].
  const Vector &guide_force() const { return guide_force_; }
  const Vector &guide_moment() const { return guide_moment_; }

private:
  Vector spin_at(const double (&orientation)[3][3], Vector &momentum) const;

  RigidInertia inertia_;
  Motion motion_;
  Vector guide_force_{}, guide_moment_{};
};

} // namespace bergamo::fe
