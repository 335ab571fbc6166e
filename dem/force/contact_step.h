#pragma once

#include "dem/force/contact_state.h"

#include <cmath>
#include <span>
#include <utility>

namespace bergamo::dem
{

/// Rigid motion of the two bodies of a contact since the last step.
struct ContactMotion
{
  double rotation; ///< bound of the motion of a surface point by rotation [m]
  Vec3 mean_turn;  ///< mean rotation of both bodies [rad]
};

/// Energy stored in a contact if its overlap were the one given [m, J].
inline double energy_at(ContactState s, const double overlap)
{
  s.overlap = overlap;
  return stored_energy(s).sum();
}

/// Brings one contact to this step: follow its rigid motion while that is within the budget, else search; then force
/// and losses, or the end of the contact.
/// @param displacement_at displacement_at(s): motion of body 2 relative to body 1 at the contact point of s [m]
/// @param search search(s): sets the geometry of s at this step, overlap <= 0 if the bodies are apart
/// @return force on body 1 with the contact's weight [N]; zero if the bodies are apart (s.touching == 0)
template <class DisplacementAt, class Search>
Vec3 step_contact(ContactState &s, const ContactLaw &law, const ContactMotion &motion, const double time_step,
                  DisplacementAt &&displacement_at, Search &&search)
{
  const bool was_touching = s.touching != 0.;
  const double old_overlap = was_touching ? s.overlap : 0.;
  Vec3 displacement = Vec3::Zero();
  if (was_touching)
  {
    displacement = displacement_at(s);
    s.overlap -= s.normal.dot(displacement);
    s.motion += displacement.norm() + motion.rotation;
    s.spin += s.normal.dot(motion.mean_turn);
  }
  if (!was_touching || s.motion > s.motion_budget || !(s.overlap > 0.))
  {
    const ContactState before = s;
    search(s);
    if (!(s.overlap > 0.))
    {
      if (was_touching)
      {
        const Vec3 separating_direction = s.normal;
        s = before;
        separate(s, old_overlap, displacement);
        s.normal = separating_direction;
      }
      return Vec3::Zero();
    }
    if (was_touching)
      s.curvature_work += energy_at(s, old_overlap) - energy_at(before, old_overlap);
    displacement = displacement_at(s);
  }
  return s.weight * advance_contact(s, law, old_overlap, displacement, time_step);
}

/// Weighted energies lost in contacts and put in by changes of their stiffness since the start of a run [J]. The
/// stiffness follows the curvature at the contact, so the force of rolling non-spherical grains has no potential: what
/// that gives or takes is booked as curvature work.
struct ContactLosses
{
  double friction = 0., viscous = 0., curvature = 0.;

  void take(ContactState &s)
  {
    friction += std::exchange(s.friction_loss, 0.);
    viscous += std::exchange(s.viscous_loss, 0.);
    curvature += std::exchange(s.curvature_work, 0.);
  }
};

inline ContactLosses sum_losses(ContactLosses sum, const std::span<const ContactState> states)
{
  for (const ContactState &s : states)
  {
    sum.friction += s.friction_loss;
    sum.viscous += s.viscous_loss;
    sum.curvature += s.curvature_work;
  }
  return sum;
}

inline ContactEnergy sum_energy(const std::span<const ContactState> states)
{
  ContactEnergy sum;
  for (const ContactState &s : states)
  {
    const ContactEnergy e = stored_energy(s);
    sum.normal += e.normal;
    sum.tangential += e.tangential;
  }
  return sum;
}

} // namespace bergamo::dem
