#pragma once

#include "dem/core/pack.h"

namespace bergamo::dem
{

/// Tangential stiffness of a contact whose ellipse has two axes, over sqrt(overlap) [N/m^1.5]; vectors in the frame of
/// these axes. The energy that a force stores in the spring for an overlap of one, f.C.f / 2, is scaled_energy(f) /
/// scale: callers share the division.
template <class Real>
struct EllipticStiffness
{
  using Vector = Vector2<Real>;
  Real major, minor, scale;

  EllipticStiffness(const Real &major, const Real &minor) : major(major), minor(minor), scale(major * minor) {}

  Vector increment(const Vector &displacement) const { return {major * displacement[0], minor * displacement[1]}; }
  Real scaled_energy(const Vector &force) const
  {
    return Real(0.5) * (force[0] * force[0] * minor + force[1] * force[1] * major);
  }
};

/// Tangential stiffness of a round contact, over sqrt(overlap) [N/m^1.5]; global vectors in the tangent plane.
template <class Real>
struct RoundStiffness
{
  using Vector = Vector3<Real>;
  Real scale;

  explicit RoundStiffness(const Real &stiffness) : scale(stiffness) {}

  Vector increment(const Vector &displacement) const { return displacement * scale; }
  Real scaled_energy(const Vector &force) const { return Real(0.5) * force.squaredNorm(); }
};

/// Energy stored by a force in the tangential spring of a contact [J]. @param root square root of its overlap, > 0
template <class Real, class Stiffness>
Real tangential_energy(const Stiffness &stiffness, const typename Stiffness::Vector &force, const Real &root)
{
  return stiffness.scaled_energy(force) / (stiffness.scale * root);
}

/// Tangential force after a step and the energy that the step lost [N, J].
template <class Real, class Vector>
struct TangentialStep
{
  Vector force;
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
auto tangential_step(const Stiffness &stiffness, const Real &root, const Real &old_root,
                     const typename Stiffness::Vector &old_force, const typename Stiffness::Vector &displacement,
                     const Real &limit) -> TangentialStep<Real, typename Stiffness::Vector>
{
  using Vector = typename Stiffness::Vector;
  using math::select;
  const Real from = select(old_root <= Real(0.), root, old_root);  // a NaN stays one, here and in what follows
  const Real inverse = Real(1.) / (stiffness.scale * root * from); // one division for all
  const Real share = inverse * from, old_share = inverse * root;
  const Real shrink = select(from <= root, Real(1.), Real(root * old_share * stiffness.scale));
  const Vector trial = old_force * shrink + stiffness.increment(displacement) * root;
  const Real square = trial.squaredNorm();
  const auto sticks = square <= limit * limit;
  const Vector force =
      trial * select(sticks, Real(1.), Real(limit * math::inverse_sqrt(select(sticks, Real(1.), square))));
  const Real work = Real(0.5) * (old_force + force).dot(displacement);
  return {force, work - (stiffness.scaled_energy(force) * share - stiffness.scaled_energy(old_force) * old_share)};
}

} // namespace bergamo::dem
