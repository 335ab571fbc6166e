#pragma once

#include "dem/force/contact_law.h"

#include <limits>

namespace bergamo::dem
{

/// What a touching contact remembers from step to step. Plain doubles only, so that it is stored and restored as a
/// block; for Real = Pack, a pack of contacts. Vectors are global; the normal points from body 1 to body 2.
template <class Real>
struct ContactState
{
  Vector3<Real> normal;
  Vector3<Real> point; ///< contact point minus the midpoint of both centres (walls: minus the grain's centre) [m]
  Vector3<Real> major_axis;
  ContactForces<Real> forces;
  Real overlap; ///< [m], > 0
  HertzMindlin<Real> stiffness;
  Real reduced_mass; ///< [kg]
  Real weight;       ///< share of the contact in the virtual work
  Real radius;       ///< that turns rotation into motion at the contact [m]
  Real budget;       ///< relative motion at the contact that is left before it is searched anew [m]
  Real spin;         ///< mean rotation about the normal since the last search [rad]

  EllipticStiffness<Real> tangential_stiffness() const
  {
    return {stiffness.tangential_major, stiffness.tangential_minor, normal, major_axis};
  }

  /// A contact about to begin: no force, no overlap yet.
  static ContactState begin()
  {
    const Vector3<Real> zero(Real(0.), Real(0.), Real(0.));
    const Real nought(0.), one(1.);
    return {zero, zero, zero, {zero, nought}, nought, {one, one, one}, one, nought, nought, nought, nought};
  }

  /// Fills unused lanes: stays as it is, without weight, and is never due.
  static ContactState idle()
  {
    ContactState s = begin();
    s.overlap = Real(1.);
    s.budget = Real(std::numeric_limits<double>::infinity());
    return s;
  }
};

/// A contact of two spheres: its geometry follows from the centres at every step.
template <class Real>
struct SphereContactState
{
  ContactForces<Real> forces;
  Real root_overlap;                           ///< square root of the overlap [m^0.5]
  Real normal_stiffness, tangential_stiffness; ///< as in HertzMindlin
  Real reduced_mass, weight;
  Real radius_sum, radius_difference; ///< r1 + r2, r1 - r2 [m]

  Real overlap() const { return root_overlap * root_overlap; }

  static SphereContactState idle()
  {
    const Real nought(0.), one(1.);
    return {{Vector3<Real>(nought, nought, nought), nought}, one, one, one, one, nought, one, nought};
  }
};

/// Energy stored in a contact with its weight [J].
struct ContactEnergy
{
  double normal = 0., tangential = 0.;

  double sum() const { return normal + tangential; }
};

inline ContactEnergy stored_energy(const ContactState<double> &s)
{
  if (!(s.overlap > 0.))
    return {};
  const double root = std::sqrt(s.overlap);
  return {s.weight * 0.4 * s.stiffness.normal * root * s.overlap * s.overlap,
          s.weight * tangential_energy(s.tangential_stiffness(), s.forces.tangential, root)};
}

inline ContactEnergy stored_energy(const SphereContactState<double> &s)
{
  const double overlap = s.overlap();
  return {s.weight * 0.4 * s.normal_stiffness * s.root_overlap * overlap * overlap,
          s.weight *
              tangential_energy(RoundStiffness<double>(s.tangential_stiffness), s.forces.tangential, s.root_overlap)};
}

/// Losses when a contact is forgotten: what its tangential spring still held counts as lost by friction.
template <class State>
ContactLosses release(const State &s)
{
  return {stored_energy(s).tangential, 0., 0.};
}

/// Losses when a contact came apart during this step: those of its last step (trapezoidal rule), and its spring's.
/// @param s as last step left it; @param normal last step's
/// @param displacement motion of body 2 relative to body 1 at the contact point since last step [m]
template <class State>
ContactLosses separate(const State &s, const Vec3 &normal, const Vec3 &displacement)
{
  ContactLosses losses = release(s);
  losses.viscous = stored_energy(s).normal - s.weight * 0.5 * s.forces.normal * normal.dot(displacement);
  losses.friction += s.weight * 0.5 * s.forces.tangential.dot(displacement);
  return losses;
}

/// Takes over the result of a contact search for a touching pair; the tangential force turns with the contact.
/// @param[in,out] s with forces and spin of the last step, or ContactState::begin()
template <class Real>
void take_geometry(ContactState<Real> &s, const Vector3<Real> &normal, const Real &overlap,
                   const RelativeCurvature<Real> &curvature, const ElasticPair &elastic)
{
  s.forces.tangential = turn_force(s.forces.tangential, normal, s.spin);
  s.normal = normal;
  s.overlap = overlap;
  s.major_axis = curvature.major_axis;
  s.stiffness = hertz_mindlin(curvature.a, curvature.b, elastic);
  s.spin = Real(0.);
}

/// Forces of a contact whose geometry is at this step.
/// @param old_overlap last step's, 0 for a new contact [m]; @param[in,out] losses with the weight [J]
/// @return force on body 1 with the weight [N]
template <class Real>
Vector3<Real> advance_contact(ContactState<Real> &s, const ContactLaw &law, const Real &old_overlap,
                              const Vector3<Real> &displacement, const double time_step, Losses<Real> &losses)
{
  Losses<Real> lost;
  advance_forces(law, s.normal, s.stiffness.normal, s.tangential_stiffness(), s.reduced_mass, math::sqrt(s.overlap),
                 math::sqrt(old_overlap), displacement, time_step, s.forces, lost);
  losses.friction += s.weight * lost.friction;
  losses.viscous += s.weight * lost.viscous;
  return s.forces.on_body1(s.normal) * s.weight;
}

/// Energy that a change of the stiffness puts into a contact at the overlap of last step [J], with the weight.
/// @param before, after as last step left the contact and with the stiffness of this one
template <class Real>
Real curvature_work(const ContactState<Real> &before, const ContactState<Real> &after, const Real &old_overlap)
{
  const Real root = math::sqrt(old_overlap);
  const auto energy = [&](const ContactState<Real> &s) -> Real
  {
    return s.weight * (Real(0.4) * s.stiffness.normal * root * old_overlap * old_overlap +
                       tangential_energy(s.tangential_stiffness(), s.forces.tangential, root));
  };
  return math::select(old_overlap > Real(0.), Real(energy(after) - energy(before)), Real(0.));
}

} // namespace bergamo::dem
