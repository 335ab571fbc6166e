#pragma once

#include "dem/core/pack.h"

namespace bergamo::dem
{

/// Tangential stiffness of a contact whose ellipse has two axes, over sqrt(overlap) [N/m^1.5]. The energy that a force
/// stores in the spring for an overlap of one, f.C.f / 2, is scaled_energy(f) / scale: callers share the division.
template <class Real>
struct EllipticStiffness
{
  Real major, minor;
  Vector3<Real> major_axis, minor_axis; ///< unit, tangential
  Real scale;

  EllipticStiffness(const Real &major, const Real &minor, const Vector3<Real> &normal, const Vector3<Real> &major_axis)
      : major(major), minor(minor), major_axis(major_axis), minor_axis(normal.cross(major_axis)), scale(major * minor)
  {
  }

  Vector3<Real> increment(const Vector3<Real> &displacement) const
  {
    return major_axis * (major * major_axis.dot(displacement)) + minor_axis * (minor * minor_axis.dot(displacement));
  }

  Real scaled_energy(const Vector3<Real> &force) const
  {
    const Real f1 = major_axis.dot(force), f2 = minor_axis.dot(force);
    return Real(0.5) * (f1 * f1 * minor + f2 * f2 * major);
  }
};

/// Tangential stiffness of a round contact, over sqrt(overlap) [N/m^1.5].
template <class Real>
struct RoundStiffness
{
  Real scale;

  explicit RoundStiffness(const Real &stiffness) : scale(stiffness) {}

  Vector3<Real> increment(const Vector3<Real> &displacement) const { return displacement * scale; }
  Real scaled_energy(const Vector3<Real> &force) const { return Real(0.5) * force.squaredNorm(); }
};

/// Energy stored by a force in the tangential spring of a contact [J]. @param root square root of its overlap, > 0
template <class Real, class Stiffness>
Real tangential_energy(const Stiffness &stiffness, const Vector3<Real> &force, const Real &root)
{
  return stiffness.scaled_energy(force) / (stiffness.scale * root);
}

/// Tangential force after a step and the energy that the step lost [N, J].
template <class Real>
struct TangentialStep
{
  Vector3<Real> force;
  Real loss;
};

/// Tangential force of this step, Wellmann (3.25, 3.26). The loss follows from the trapezoidal rule and the energies
/// stored.
/// @param stiffness over sqrt(overlap); @param root, old_root square root of this and the last overlap, root > 0
/// @param old_force last step's force on body 1, in the present tangent plane, none for a new contact [N]. Where the
///        contact shrinks, its spring lets go of the same share of the force (Thornton & Randall 1988); without it a
///        closed loop of loading and shearing would make energy
/// @param displacement tangential motion of body 2 relative to body 1 since last step [m]
/// @param limit mu |f_N| [N]
template <class Real, class Stiffness>
TangentialStep<Real> tangential_step(const Stiffness &stiffness, const Real &root, const Real &old_root,
                                     const Vector3<Real> &old_force, const Vector3<Real> &displacement,
                                     const Real &limit)
{
  using math::select;
  const Real from = select(old_root <= Real(0.), root, old_root);  // a NaN stays one, here and in what follows
  const Real inverse = Real(1.) / (stiffness.scale * root * from); // one division for all
  const Real share = inverse * from, old_share = inverse * root;
  const Real shrink = select(from <= root, Real(1.), Real(root * old_share * stiffness.scale));
  const Vector3<Real> trial = old_force * shrink + stiffness.increment(displacement) * root;
  const Real square = trial.squaredNorm();
  const auto sticks = square <= limit * limit;
  const Vector3<Real> force =
      trial * select(sticks, Real(1.), Real(limit * math::inverse_sqrt(select(sticks, Real(1.), square))));
  const Real work = Real(0.5) * (old_force + force).dot(displacement);
  return {force, work - (stiffness.scaled_energy(force) * share - stiffness.scaled_energy(old_force) * old_share)};
}

/// The force that a contact had, turned with it onto a new tangent plane: magnitude kept (Wellmann 3.24 ff.).
/// @param spin mean rotation of both bodies about the normal since the force was last turned, |spin| < 0.5 [rad]
template <class Real>
Vector3<Real> turn_force(const Vector3<Real> &force, const Vector3<Real> &normal, const Real &spin)
{
  const Vector3<Real> flat = force - normal * normal.dot(force);
  // Only the direction counts: flat + tan(spin) normal x flat. Pade's tangent, error spin^7/4725.
  const Real square = spin * spin;
  const Real tangent = spin * (Real(15.) - square) / (Real(15.) - Real(6.) * square);
  const Vector3<Real> turned = flat + normal.cross(flat) * tangent;
  const Real length = turned.squaredNorm();
  return turned * math::select(length > Real(0.), Real(math::sqrt(force.squaredNorm() / length)), Real(0.));
}

} // namespace bergamo::dem
