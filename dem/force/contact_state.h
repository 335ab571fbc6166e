#pragma once

#include "dem/contact/geometry.h"
#include "dem/law/damping.h"
#include "dem/law/hertz.h"
#include "dem/law/mindlin.h"

namespace bergamo::dem
{

/// What one contact remembers from step to step. Plain doubles only, so that it is stored and restored as a block.
/// Vectors are global; the normal points from body 1 to body 2.
struct ContactState
{
  Vec3 normal = Vec3::Zero();
  Vec3 point = Vec3::Zero(); ///< contact point minus the midpoint of both centres (walls: minus the centre) [m]
  Vec3 major_axis = Vec3::Zero();
  Vec3 tangential_force = Vec3::Zero(); ///< on body 1, without the weight [N]
  double normal_force = 0.;             ///< f_N >= 0, without the weight [N]
  double overlap = 0.;                  ///< [m]
  HertzMindlin stiffness{0., 0., 0.};
  double reduced_mass = 0.;   ///< [kg]
  double weight = 1.;         ///< share of the contact in the virtual work
  double motion = 0.;         ///< relative motion at the contact since the last search [m]
  double motion_budget = 0.;  ///< of the motion [m]; beyond it the contact is searched anew
  double spin = 0.;           ///< mean rotation about the normal since the last search [rad]
  double friction_loss = 0.;  ///< weighted energy lost tangentially since the contact began [J]
  double viscous_loss = 0.;   ///< weighted energy lost in the dashpot since the contact began [J]
  double curvature_work = 0.; ///< weighted energy that changes of the stiffness put into the contact [J]
  double touching = 0.;       ///< 1 while the bodies touch, else 0
};

static_assert(sizeof(ContactState) % sizeof(double) == 0);

/// Constants of every contact of one kind (grain-grain or grain-wall).
struct ContactLaw
{
  ElasticPair elastic;
  double friction = 0.;      ///< Coulomb's coefficient
  double damping_ratio = 0.; ///< of the dashpot, 1 is critical
};

/// Energy stored in a contact with its weight [J].
struct ContactEnergy
{
  double normal = 0., tangential = 0.;

  double sum() const { return normal + tangential; }
};

inline TangentialStiffness tangential_stiffness(const ContactState &s, const double root_overlap)
{
  return {s.stiffness.tangential_major * root_overlap, s.stiffness.tangential_minor * root_overlap, s.major_axis,
          s.normal.cross(s.major_axis)};
}

inline ContactEnergy stored_energy(const ContactState &s)
{
  if (s.touching == 0. || !(s.overlap > 0.))
    return {};
  const double root = std::sqrt(s.overlap);
  return {s.weight * 0.4 * s.stiffness.normal * root * s.overlap * s.overlap,
          s.weight * tangential_energy(tangential_stiffness(s, root), s.tangential_force)};
}

/// Forgets a contact: what its tangential spring still held counts as lost by friction.
inline void release(ContactState &s)
{
  s.friction_loss += stored_energy(s).tangential;
  s.tangential_force.setZero();
  s.normal_force = 0.;
  s.overlap = 0.;
  s.touching = 0.;
}

/// Ends a contact that came apart during this step, with the losses of its last step (trapezoidal rule).
/// @param displacement motion of body 2 relative to body 1 at the contact point since last step [m]
inline void separate(ContactState &s, const double old_overlap, const Vec3 &displacement)
{
  s.overlap = old_overlap;
  s.viscous_loss += stored_energy(s).normal - s.weight * 0.5 * s.normal_force * s.normal.dot(displacement);
  s.friction_loss += s.weight * 0.5 * s.tangential_force.dot(displacement);
  release(s);
}

/// Takes over the result of a contact search for a touching pair: the tangential force turns with the contact onto
/// the new tangent plane with its magnitude kept, plus the mean spin about the normal (Wellmann 3.24 ff.).
inline void take_geometry(ContactState &s, const Vec3 &normal, const double overlap, const RelativeCurvature &curvature,
                          const ElasticPair &elastic)
{
  const double size = s.tangential_force.norm();
  if (size > 0.)
  {
    Vec3 turned = s.tangential_force - normal * normal.dot(s.tangential_force);
    turned += std::sin(s.spin) * normal.cross(turned) + (std::cos(s.spin) - 1.) * turned;
    const double length = turned.norm();
    s.tangential_force = length > 0. ? Vec3(turned * (size / length)) : Vec3::Zero();
  }
  s.normal = normal;
  s.overlap = overlap;
  s.major_axis = curvature.major_axis;
  s.stiffness = hertz_mindlin(curvature.a, curvature.b, elastic);
  s.motion = 0.;
  s.spin = 0.;
  s.touching = 1.;
}

/// Force of a touching contact at this step, and its energy losses by the trapezoidal rule, which closes the energy
/// balance of the leapfrog scheme.
/// @param s with this step's overlap > 0 in place; @param old_overlap last step's, <= 0 for a new contact [m]
/// @param displacement motion of body 2 relative to body 1 at the contact point since last step [m]
/// @return force on body 1, without the weight [N]
inline Vec3 advance_contact(ContactState &s, const ContactLaw &law, const double old_overlap, const Vec3 &displacement,
                            const double time_step)
{
  const double approach = -s.normal.dot(displacement);
  const Vec3 sliding = displacement + approach * s.normal;
  const double root = std::sqrt(s.overlap);
  const double old_root = std::sqrt(std::max(old_overlap, 0.));

  const double elastic_force = s.stiffness.normal * root * s.overlap;
  const double viscous_force =
      dashpot(law.damping_ratio, 1.5 * s.stiffness.normal * root, s.reduced_mass, approach / time_step);
  const double normal_force = std::max(elastic_force + viscous_force, 0.);

  const TangentialStiffness k = tangential_stiffness(s, root);
  const double shrink = old_root > root ? root / old_root : 1.;
  const Vec3 tangential = tangential_force(k, s.tangential_force, shrink, sliding, law.friction * normal_force);

  const double old_elastic =
      0.4 * s.stiffness.normal * old_root * std::max(old_overlap, 0.) * std::max(old_overlap, 0.);
  const double elastic = 0.4 * elastic_force * s.overlap;
  s.viscous_loss += s.weight * (0.5 * (s.normal_force + normal_force) * approach - (elastic - old_elastic));

  const double old_stored =
      old_root > 0. ? tangential_energy(tangential_stiffness(s, old_root), s.tangential_force) : 0.;
  s.friction_loss += s.weight * (0.5 * (s.tangential_force + tangential).dot(sliding) -
                                 (tangential_energy(k, tangential) - old_stored));

  s.normal_force = normal_force;
  s.tangential_force = tangential;
  return tangential - normal_force * s.normal;
}

} // namespace bergamo::dem
