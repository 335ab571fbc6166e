#pragma once

#include "dem/force/contact_state.h"
#include "dem/state/periodic_cell.h"

#include <cstdint>

namespace bergamo::dem
{

/// The second body of a contact with a wall.
inline constexpr std::int32_t no_grain = -1;

/// The state of a contact of any kind, in global vectors; its normal points from body 1 to body 2.
struct ContactView
{
  Vec3 normal = Vec3::Zero();
  Vec3 major_axis = Vec3::Zero(); ///< of the contact ellipse, turned with the contact since it was searched
  Vec3 point = Vec3::Zero();      ///< minus the midpoint of both centres (walls: minus the grain's centre) [m]
  ContactForces<double, Vec3> forces{Vec3::Zero(), 0.}; ///< tangential on body 1, without the weight
  double overlap = 0.;                                  ///< [m]
  HertzMindlin<double> stiffness{};
  double reduced_mass = 0.; ///< [kg]
  double weight = 0.;       ///< share of the contact in the virtual work
  ContactEnergy energy;

  /// On body 1, without the weight [N].
  Vec3 force() const { return forces.tangential - forces.normal * normal; }
};

inline const ContactEnergy &stored_energy(const ContactView &contact)
{
  return contact.energy;
}

inline ContactView view_of(const ContactState<double> &s)
{
  return {s.normal,       s.axis,   s.point,         {s.tangential_force(), s.forces.normal}, s.overlap, s.stiffness,
          s.reduced_mass, s.weight, stored_energy(s)};
}

/// One touching contact as a reader sees it.
struct TouchingContact
{
  std::int32_t first, second; ///< particles; the second may be no_grain
  ContactView state;
  Vec3 branch;             ///< centre of body 2, in its image, minus centre of body 1; walls: to the contact point [m]
  Image image = own_image; ///< of body 2, see PeriodicCell
  std::int32_t wall = -1;  ///< that is body 2, else negative
  std::int32_t law = 0;    ///< number of the pair of materials, see MaterialTable
  std::int32_t feature = -1; ///< of a surface that is body 2, see feature_of(), else negative
};

} // namespace bergamo::dem
