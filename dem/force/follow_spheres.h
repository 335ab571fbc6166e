#pragma once

#include "dem/force/contact_state.h"
#include "dem/force/pair_motion.h"
#include "dem/geometry/centre_line.h"

namespace bergamo::dem
{

/// Geometry of spheres in contact; Real is double or Pack.
template <class Real>
struct SphereGeometry
{
  Vector3<Real> normal;
  Vector3<Real> point; ///< minus the midpoint of the centres [m]
  Real overlap;        ///< [m]

  Real half_distance, one_over_half_distance; ///< of the centres [m, 1/m]

  /// @param half_line half of x2 - x1 [m]; spheres at one place get the normal of dem/geometry/centre_line.h
  SphereGeometry(const Vector3<Real> &half_line, const Real &radius_sum, const Real &radius_difference)
  {
    const Real square = half_line.squaredNorm();
    const auto is_line = square > Real(0.);
    one_over_half_distance =
        math::select(is_line, math::inverse_sqrt(math::select(is_line, square, Real(1.))), Real(0.));
    half_distance = square * one_over_half_distance;
    normal =
        math::select<Real>(is_line, Vector3<Real>(half_line * one_over_half_distance), normal_without_line<Real>());
    overlap = radius_sum - half_distance - half_distance;
    point = normal * (Real(0.5) * radius_difference);
  }

  /// Rotation of the contact in the step [rad].
  Vector3<Real> turn(const PairMotion<Real> &motion) const
  {
    const Real share = Real(0.5 * motion.time_step) * one_over_half_distance * one_over_half_distance;
    return motion.half_line.cross(motion.velocity) * share + normal * motion.turn_about(normal);
  }
};

/// Motion of a contact of spheres in the step, in the tangent plane at its end.
template <class Real>
ContactMotion<Real, Vector3<Real>>
motion_of_spheres(const SphereGeometry<Real> &g, const SphereContactState<Real> &state, const PairMotion<Real> &motion)
{
  const Vector3<Real> halfway = motion.middle() * (Real(0.5) * state.radius_difference * g.one_over_half_distance);
  const Vector3<Real> displacement = motion.displacement(halfway);
  const Vector3<Real> turned = displacement + g.turn(motion).cross(displacement) * Real(0.5);
  const Real apart = g.normal.dot(turned);
  return {-apart, turned - g.normal * apart};
}

/// Contacts of spheres after a step.
template <class Real>
struct FollowedSpheres
{
  math::Mask<Real> is_apart;      ///< came apart: the state is left as last step left it
  Vector3<Real> force;            ///< on body 1 with the weight, zero where apart [N]
  Vector3<Real> torque1, torque2; ///< about the centres, likewise [N m]
};

/// Brings contacts of spheres to this step. @param[in,out] losses with the weights [J]
template <class Real>
FollowedSpheres<Real> follow(SphereContactState<Real> &state, const PairMotion<Real> &motion, const ContactLaw &law,
                             Losses<Real> &losses)
{
  using math::select, math::sqrt;
  const SphereGeometry<Real> g(motion.half_line, state.radius_sum, state.radius_difference);
  const math::Mask<Real> is_apart = g.overlap <= Real(0.);
  const Real root = sqrt(select(is_apart, Real(1.), g.overlap));
  const ContactMotion<Real, Vector3<Real>> seen = motion_of_spheres(g, state, motion);

  // The force turns with the line of the centres and, about it, with the mean of both spins (Wellmann 3.24 ff.):
  // f + w x f + w x (w x f) / 2 keeps its magnitude to w^4 / 8, a step's share of 1e-13 for a milliradian.
  const Vector3<Real> turn = g.turn(motion);
  const Vector3<Real> first = turn.cross(state.forces.tangential);
  Vector3<Real> old_force = state.forces.tangential + first + turn.cross(first) * Real(0.5);
  old_force = old_force - g.normal * g.normal.dot(old_force);

  ContactForces<Real, Vector3<Real>> forces{old_force, state.forces.normal};
  Losses<Real> lost;
  advance_forces(law, state.normal_stiffness, RoundStiffness<Real>(state.tangential_stiffness), state.reduced_mass,
                 root, state.root_overlap, seen, motion.time_step, forces, lost);
  losses += losses_where<Real>(!is_apart, lost * state.weight);

  state.root_overlap = select(is_apart, state.root_overlap, root);
  state.forces.normal = select(is_apart, state.forces.normal, forces.normal);
  state.forces.tangential = select<Real>(is_apart, state.forces.tangential, forces.tangential);

  // Both arms lie along the normal, and both torques are parallel.
  const Real weight = select(is_apart, Real(0.), state.weight), beside = Real(0.5) * state.radius_difference;
  const Vector3<Real> torque_of_unit_arm = g.normal.cross(forces.tangential) * weight;
  return {is_apart, (forces.tangential - g.normal * forces.normal) * weight,
          torque_of_unit_arm * (g.half_distance + beside), torque_of_unit_arm * (g.half_distance - beside)};
}

} // namespace bergamo::dem
