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
/// @param[in,out] losses with the weights [J]; @param target target(lane): Resultant &
/// @return lanes that came apart, whose state is left as last step left it
template <class Real, class Target>
math::Mask<Real> follow(SphereContactState<Real> &state, const PairMotion<Real> &motion, const ContactLaw &law,
                        Losses<Real> &losses, const Target &target)
{
  using math::max, math::select, math::sqrt;
  const SphereGeometry<Real> g(motion.half_line, state.radius_sum, state.radius_difference);
  const math::Mask<Real> is_apart = g.overlap <= Real(0.);
  const Real old_root = state.root_overlap, old_overlap = state.overlap();
  const Real root = sqrt(select(is_apart, Real(1.), g.overlap)), overlap = root * root;
  const Real dt(motion.time_step);

  // The force turns with the line of the centres and, about it, with the mean of both spins (Wellmann 3.24 ff.):
  // f + w x f + w x (w x f) / 2 keeps its magnitude to w^4 / 8, a step's share of 1e-13 for a milliradian.
  const Vector3<Real> line_turn =
      motion.half_line.cross(motion.velocity) * (Real(0.5) * dt * g.one_over_half_distance * g.one_over_half_distance);
  const Vector3<Real> turn = line_turn + g.normal * motion.turn_about(g.normal);
  const Vector3<Real> first = turn.cross(state.forces.tangential);
  Vector3<Real> old_force = state.forces.tangential + first + turn.cross(first) * Real(0.5);
  old_force = old_force - g.normal * g.normal.dot(old_force);

  const Vector3<Real> displacement = motion.displacement(g.point);
  const Real approach = -g.normal.dot(displacement);
  const Vector3<Real> sliding = displacement + g.normal * approach;

  const Real elastic_force = state.normal_stiffness * root * overlap;
  const Real damping = normal_damping(law, Real(Real(1.5) * state.normal_stiffness * root), state.reduced_mass);
  const Real normal_force = max(Real(elastic_force + damping * approach * Real(1. / motion.time_step)), Real(0.));
  const Real old_elastic = Real(0.4) * state.normal_stiffness * old_root * old_overlap * old_overlap;
  const Real viscous =
      Real(0.5) * (state.forces.normal + normal_force) * approach - (Real(0.4) * elastic_force * overlap - old_elastic);

  const RoundStiffness<Real> stiffness(state.tangential_stiffness);
  const TangentialStep<Real> step =
      tangential_step(stiffness, root, old_root, old_force, sliding, Real(Real(law.friction) * normal_force));
  losses.friction += select(is_apart, Real(0.), Real(state.weight * step.loss));
  losses.viscous += select(is_apart, Real(0.), Real(state.weight * viscous));

  // Both arms lie along the normal, so the torques are parallel.
  const Vector3<Real> unit_torque = g.normal.cross(step.force) * state.weight;
  const Real beside = Real(0.5) * state.radius_difference;
  store_resultants<Real>((step.force - g.normal * normal_force) * state.weight,
                         unit_torque * (g.half_distance + beside), unit_torque * (g.half_distance - beside), target);

  state.root_overlap = select(is_apart, old_root, root);
  state.forces.normal = select(is_apart, state.forces.normal, normal_force);
  state.forces.tangential = select<Real>(is_apart, state.forces.tangential, step.force);
  return is_apart;
}

} // namespace bergamo::dem
