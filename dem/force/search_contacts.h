#pragma once

#include "dem/force/contact_law.h"
#include "dem/force/contact_parameters.h"
#include "dem/force/contact_state.h"
#include "dem/force/pair_motion.h"
#include "dem/state/particles.h"

#include <cstdint>
#include <span>

namespace bergamo::dem
{

/// A pair of grains whose contact is to be searched, and what came of it.
struct ContactSearch
{
  std::int32_t first, second; ///< grains
  Vec3 guess;                 ///< normal of an earlier search, or zero for a pair never searched
  ContactState<double> state; ///< as last step left it, or ContactState::begin(); the outcome if touching

  bool is_touching = false;
  bool is_undecided = false;
  double gap = 0.;          ///< lower bound where apart [m]
  Resultant resultant = {}; ///< where touching
};

/// Searches as many pairs as Real has lanes at the present poses, from their guesses; a touching pair gets this step's
/// state and forces, a pair apart a separating direction in `guess`.
/// @param searches at most width<Real>; @param[in,out] losses with the weights [J]
template <class Real>
void search_contacts(std::span<ContactSearch> searches, const Particles &particles, const ContactLaw &law,
                     const ContactParameters &parameters, double time_step, ContactLosses &losses);

} // namespace bergamo::dem
