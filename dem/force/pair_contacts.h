#pragma once

#include "dem/force/contact_parameters.h"
#include "dem/force/contact_step.h"
#include "dem/force/resultant.h"
#include "dem/neighbour/verlet_list.h"
#include "dem/state/particles.h"

#include <vector>

namespace bergamo::dem
{

/// Contacts between grains: the Verlet list with each pair's history beside it.
struct PairContacts
{
  VerletList list;
  std::vector<ContactState> state; ///< one a pair
  /// A separated pair cannot touch before the motions of both particles add up to this [m]: it is left alone until
  /// then, which is exact. Touching pairs carry -infinity.
  std::vector<double> rest_until;
  std::vector<Resultant> resultant; ///< one a pair, of this step; valid where state.touching
  ContactLosses losses;             ///< of pairs that left the list
  std::int64_t n_undecided = 0;     ///< searches that ended without a decision, since the start
  std::int64_t n_searches = 0;      ///< evaluations of the geometry of a pair, since the start

  /// Replaces the list, keeping the history of every pair that stays. History of pairs that leave is booked as loss.
  void renew(VerletList new_list, const Particles &particles);

  /// Follows a new order of the particles, order[new] = old. The list must be renewed afterwards.
  void reorder(const std::vector<std::int32_t> &order, const Particles &reordered);

  /// Brings every pair to this step: geometry where needed, then forces into `resultant`.
  void compute(const Particles &particles, const ContactLaw &law, const ContactParameters &parameters,
               double time_step);

  /// Losses of all contacts since the start [J].
  ContactLosses total_losses() const { return sum_losses(losses, state); }

  /// Energy stored in all contacts [J].
  ContactEnergy total_energy() const { return sum_energy(state); }
};

} // namespace bergamo::dem
