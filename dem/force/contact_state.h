#pragma once

#include "dem/force/contact_law.h"
#include "dem/geometry/contact_geometry.h"

#include <limits>

namespace bergamo::dem
{

/// What a touching contact remembers from step to step. Plain doubles only, so that it is stored and restored as a
/// block; for Real = Pack, a pack of contacts. Vectors are global; the normal points from body 1 to body 2. The tangent
/// frame (axis, normal x axis) turns with the contact: what stands in it keeps its numbers.
template <class Real>
struct ContactState
{
  using Forces = ContactForces<Real, Vector2<Real>>;

  Vector3<Real> normal;
  Vector3<Real> axis;  ///< unit, tangential: the major one of the contact ellipse at the last search
  Vector3<Real> point; ///< contact point minus the midpoint of both centres (walls: minus the grain's centre) [m]
  Forces forces;       ///< in the tangent frame
  Real overlap;        ///< [m], > 0
  HertzMindlin<Real> stiffness;
  Real reduced_mass; ///< [kg]
  Real weight;       ///< share of the contact in the virtual work
  /// Radii of curvature of both surfaces less half the overlap, in the tangent frame [m]; no second ones at a plane.
  CurvatureRadii<Real> radii1, radii2;
  /// Share of the budget that a turn of the normal relative to body 1 or 2 uses up, towards both axes; and a turn of
  /// the bodies against one another about the normal [1/rad].
  Vector2<Real> wear1, wear2;
  Real twist_wear;
  Real budget; ///< left before the contact is searched anew: from 1 down to 0; see also `lost`

  /// The budget of a contact that a step could not follow, and has left as the last step left it.
  static constexpr double lost = -std::numeric_limits<double>::infinity();

  Real root() const { return math::sqrt(overlap); } ///< [m^0.5]
  Real elastic_force() const { return dem::elastic_force(stiffness.normal, root()); }
  Vector3<Real> second_axis() const { return normal.cross(axis); }
  EllipticStiffness<Real> tangential_stiffness() const
  {
    return {stiffness.tangential_major, stiffness.tangential_minor};
  }

  /// Tangential force on body 1 without the weight [N].
  Vector3<Real> tangential_force() const { return axis * forces.tangential[0] + second_axis() * forces.tangential[1]; }

  /// Force on body 1 with the weight [N].
  Vector3<Real> force() const { return (tangential_force() - normal * forces.normal) * weight; }

  /// A contact about to begin: no force, no overlap yet.
  static ContactState begin()
  {
    const Real nought(0.), one(1.);
    const Vector3<Real> zero(nought, nought, nought);
    const CurvatureRadii<Real> none{nought, nought, nought};
    const Vector2<Real> no_wear(nought, nought);
    return {zero,    zero,
            zero,    {{nought, nought}, nought},
            nought,  {one, one, one},
            one,     nought,
            none,    none,
            no_wear, no_wear,
            nought,  Real(lost)};
  }

  /// Fills unused lanes: stays as it is, without weight, and is never due.
  static ContactState idle()
  {
    ContactState s = begin();
    s.overlap = Real(1.);
    s.radii1 = s.radii2 = {Real(1.), Real(1.), Real(0.)};
    s.budget = Real(std::numeric_limits<double>::infinity());
    return s;
  }
};

/// A contact with a feature of a surface, which also counts what friction does there.
template <class Real>
struct SurfaceContactState : ContactState<Real>
{
  Real friction_work; ///< lost tangentially since it began or the accounts were opened, with the weight [J]

  static SurfaceContactState begin() { return {ContactState<Real>::begin(), Real(0.)}; }
  static SurfaceContactState idle() { return {ContactState<Real>::idle(), Real(0.)}; }
};

/// A contact of two spheres: its geometry follows from the centres at every step.
template <class Real>
struct SphereContactState
{
  ContactForces<Real, Vector3<Real>> forces;   ///< global
  Real root_overlap;                           ///< square root of the overlap [m^0.5]
  Real normal_stiffness, tangential_stiffness; ///< as in HertzMindlin
  Real reduced_mass, weight;
  Real radius_sum, radius_difference; ///< r1 + r2, r1 - r2 [m]

  Real root() const { return root_overlap; }
  Real overlap() const { return root_overlap * root_overlap; }
  Real elastic_force() const { return dem::elastic_force(normal_stiffness, root_overlap); }

  static SphereContactState idle()
  {
    const Real nought(0.), one(1.);
    return {{Vector3<Real>(nought, nought, nought), nought}, one, one, one, one, nought, one, nought};
  }
};

/// Energy stored in a contact with its weight [J].
template <class Real>
struct SpringEnergy
{
  Real normal = Real(0.), tangential = Real(0.);

  Real sum() const { return normal + tangential; }
};
using ContactEnergy = SpringEnergy<double>;

/// Of a contact in touch.
template <class Real>
SpringEnergy<Real> spring_energy(const ContactState<Real> &s)
{
  return {s.weight * elastic_energy(s.elastic_force(), s.overlap),
          s.weight * tangential_energy(s.tangential_stiffness(), s.forces.tangential, s.root())};
}

inline ContactEnergy stored_energy(const ContactState<double> &s)
{
  return s.overlap > 0. ? spring_energy(s) : ContactEnergy{};
}

inline ContactEnergy stored_energy(const SphereContactState<double> &s)
{
  return {s.weight * elastic_energy(s.elastic_force(), s.overlap()),
          s.weight *
              tangential_energy(RoundStiffness<double>(s.tangential_stiffness), s.forces.tangential, s.root_overlap)};
}

/// Losses when a contact is forgotten: what its tangential spring still held counts as lost by friction.
template <class State>
ContactLosses release(const State &s)
{
  return {.friction = stored_energy(s).tangential};
}

/// Losses when a contact came apart during this step: those of its last step (trapezoidal rule), and its spring's.
/// @param s as last step left it; @param motion since
template <class State, class Vector>
ContactLosses separate(const State &s, const ContactMotion<double, Vector> &motion)
{
  ContactLosses losses = release(s);
  const double elastic = s.elastic_force(), half_way = 0.5 * s.weight * motion.approach;
  losses.friction += 0.5 * s.weight * s.forces.tangential.dot(motion.sliding);
  losses.viscous = (s.forces.normal - elastic) * half_way;
  losses.quadrature = -stored_energy(s).normal - elastic * half_way;
  return losses;
}

/// Forces of a contact whose geometry is at this step.
/// @param old_overlap last step's, 0 for a new contact [m]; @param[in,out] losses with the weight [J]
template <class Real>
void advance_contact(ContactState<Real> &s, const ContactLaw &law, const Real &old_overlap,
                     const ContactMotion<Real, Vector2<Real>> &motion, const double time_step, Losses<Real> &losses)
{
  Losses<Real> lost;
  advance_forces(law, s.stiffness.normal, s.tangential_stiffness(), s.reduced_mass, math::sqrt(s.overlap),
                 math::sqrt(old_overlap), motion, time_step, s.forces, lost);
  losses += lost * s.weight;
}

} // namespace bergamo::dem
