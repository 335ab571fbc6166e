#pragma once

#include "dem/force/contact_parameters.h"
#include "dem/force/contact_state.h"
#include "dem/force/contact_store.h"
#include "dem/state/particles.h"
#include "dem/state/wall.h"

#include <cstdint>
#include <vector>

namespace bergamo::dem
{

/// Contacts of grains with plane walls: candidates sorted by particle and then wall, the touching ones with their
/// history in blocks of packs, as in PairContacts. Body 1 is the grain, body 2 the wall: the contact normal is minus
/// the wall's normal.
struct WallContacts
{
  std::vector<std::int32_t> row; ///< candidates of particle i: row[i] .. row[i + 1]
  std::vector<std::int32_t> particle, wall;
  std::vector<std::int32_t> slot; ///< in `touching`, or `apart`
  std::vector<double>
      rest_until; ///< of candidates apart, as in PairContacts, against particle.motion + wall.motion [m]
  std::vector<double>
      group_rest_until; ///< as in PairContacts, against particles.largest_motion plus all walls' motion [m]
  ContactStore<ContactState> touching; ///< its `pair` is the candidate, its `second` the wall
  ContactLosses losses;                ///< since the start [J]
  std::int64_t n_searches = 0;

  static constexpr std::int32_t apart = -1;

  std::size_t size() const { return wall.size(); }
  bool is_touching(const std::size_t k) const { return slot[k] != apart; }
  ContactState<double> state(const std::size_t k) const { return touching.get(slot[k]); }

  /// Lists the grains nearer to a wall than their bounding radius plus range [m]; history stays with its contact.
  void renew(const Particles &particles, const std::vector<PlaneWall> &walls, double range);

  /// Follows a new order of the particles, order[new] = old. The list must be renewed afterwards.
  void reorder(const std::vector<std::int32_t> &order);

  /// Drops all contacts of one wall, whose history is booked as loss; later walls move up by one.
  void remove_wall(std::int32_t index);

  /// Brings every contact to this step; adds the grains' forces to the walls, in a fixed order.
  void compute(const Particles &particles, std::vector<PlaneWall> &walls, const ContactLaw &law,
               const ContactParameters &parameters, double time_step);

  /// Adds what the walls give to grain i, in a fixed order.
  void add_resultants(std::int32_t i, GrainLoad &load) const;

  /// Has every contact searched anew at the next step.
  void refresh();

  /// Energy stored in all contacts [J].
  ContactEnergy total_energy() const;
};

} // namespace bergamo::dem
