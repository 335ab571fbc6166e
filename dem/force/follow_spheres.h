#pragma once

#include "dem/force/contact_state.h"
#include "dem/force/pair_motion.h"

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

  /// @param half_line half of x2 - x1 [m]; an unused lane, without a line, gets no normal
  SphereGeometry(const Vector3<Real> &half_line, const Real &radius_sum, const Real &radius_difference)
  {
    half_distance = half_line.norm();
    one_over_half_distance = math::select(half_distance > Real(0.), Real(Real(1.) / half_distance), Real(0.));
    normal = half_line * one_over_half_distance;
    overlap = radius_sum - half_distance - half_distance;
    point = normal * (Real(0.5) * radius_difference);
  }
};

/// Brings contacts of spheres to this step and writes what they give to their bodies.
/// @param[in,out] losses with the weights [J]; @param target target(lane): SphereResultant &
/// @return lanes that came apart, whose state is left as last step left it
template <class Real, class Target>
math::Mask<Real> follow(SphereContactState<Real> &state, const PairMotion<Real> &motion, const ContactLaw &law,
                        Losses<Real> &losses, const Target &target)
{
  using math::select, math::sqrt;
  const SphereGeometry<Real> g(motion.half_line, state.radius_sum, state.radius_difference);
  const math::Mask<Real> is_apart = g.overlap <= Real(0.);
  const Real root = sqrt(select(is_apart, Real(1.), g.overlap));
  const Real dt(motion.time_step);

  // The force turns with the line of the centres and, about it, with the mean of both spins (Wellmann 3.24 ff.):
  // f + w x f + w x (w x f) / 2 keeps its magnitude to w^4 / 8, a step's share of 1e-13 for a milliradian.
  const Vector3<Real> line_turn =
      motion.half_line.cross(motion.velocity) * (Real(0.5) * dt * g.one_over_half_distance * g.one_over_half_distance);
  const Vector3<Real> turn = line_turn + g.normal * motion.turn_about(g.normal);
  const Vector3<Real> first = turn.cross(state.forces.tangential);
  Vector3<Real> old_force = state.forces.tangential + first + turn.cross(first) * Real(0.5);
  old_force = old_force - g.normal * g.normal.dot(old_force);

  ContactForces<Real> forces{old_force, state.forces.normal};
  Losses<Real> lost;
  advance_forces(law, g.normal, state.normal_stiffness, RoundStiffness<Real>(state.tangential_stiffness),
                 state.reduced_mass, root, state.root_overlap, motion.displacement(g.point), motion.time_step, forces,
                 lost);
  losses.friction += select(is_apart, Real(0.), Real(state.weight * lost.friction));
  losses.viscous += select(is_apart, Real(0.), Real(state.weight * lost.viscous));

  const Real beside = Real(0.5) * state.radius_difference;
  math::scatter_vectors<Real>(
      forces.on_body1(g.normal) * state.weight, [&](const int lane) -> Vec4 & { return target(lane).force; },
      g.half_distance + beside);
  math::scatter_vectors<Real>(
      g.normal.cross(forces.tangential) * state.weight, [&](const int lane) -> Vec4 & { return target(lane).torque; },
      g.half_distance - beside);

  state.root_overlap = select(is_apart, state.root_overlap, root);
  state.forces.normal = select(is_apart, state.forces.normal, forces.normal);
  state.forces.tangential = select<Real>(is_apart, state.forces.tangential, forces.tangential);
  return is_apart;
}

} // namespace bergamo::dem
