#pragma once

#include "dem/force/contact_parameters.h"
#include "dem/force/contact_state.h"
#include "dem/force/contact_store.h"
#include "dem/force/pair_motion.h"

namespace bergamo::dem
{

/// Brings one block of touching contacts to this step along the rigid motion of their grains, with the normal held.
/// Contacts whose motion budget is used up, or that may have come apart, are left as last step left them.
/// @param[in,out] losses with the weights [J]
/// @return lanes to be searched anew
math::Mask<Pack> follow_block(ContactStore<ContactState> &store, std::size_t block, const Particles &particles,
                              const ContactLaw &law, double time_step, Losses<Pack> &losses);

/// The same for contacts of spheres, whose geometry is exact at every step.
/// @return lanes that came apart
math::Mask<Pack> follow_block(ContactStore<SphereContactState> &store, std::size_t block, const Particles &particles,
                              const ContactLaw &law, double time_step, Losses<Pack> &losses);

/// Geometry of spheres in contact; Real is double or Pack.
template <class Real>
struct SphereGeometry
{
  Vector3<Real> normal;
  Vector3<Real> point; ///< minus the midpoint of the centres [m]
  Real overlap;        ///< [m]

  /// @param half_line half of x2 - x1 [m]; an unused lane, without a line, gets no normal
  SphereGeometry(const Vector3<Real> &half_line, const Real &radius1, const Real &radius2)
  {
    const Real half_distance = half_line.norm();
    normal = half_line * math::select(half_distance > Real(0.), Real(Real(1.) / half_distance), Real(0.));
    overlap = radius1 + radius2 - half_distance - half_distance;
    point = normal * (Real(0.5) * (radius1 - radius2));
  }
};

} // namespace bergamo::dem
