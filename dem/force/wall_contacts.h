#pragma once

#include "dem/core/parallel.h"
#include "dem/force/contact_parameters.h"
#include "dem/force/contact_state.h"
#include "dem/force/contact_store.h"
#include "dem/force/load_sums.h"
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
  std::vector<std::int32_t> slot;      ///< in `touching`, or `apart`
  std::vector<double> rest_until;      ///< as in PairContacts, against particle.motion + wall.motion [m]
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

  /// Brings every contact to this step and sums the grains' forces on the walls, in a fixed order.
  void compute(const Particles &particles, std::vector<PlaneWall> &walls, const ContactLaw &law,
               const ContactParameters &parameters, double time_step);

  /// Adds what the walls give to grain i, in a fixed order.
  void add_load(const std::size_t i, BodyLoad &load) const { loads.add_load(i, load); }

  /// Has every contact searched anew at the next step.
  void refresh();

  /// Energy stored in all contacts [J].
  ContactEnergy total_energy() const;

private:
  /// Walls are bodies after the grains.
  static std::int32_t body_of(const std::size_t wall_index, const std::size_t n_grains)
  {
    return static_cast<std::int32_t>(n_grains + wall_index);
  }
  void list_bodies(std::size_t n_grains, std::size_t n_walls);
  math::Mask<Pack> follow_block(std::size_t block, const Particles &particles, const std::vector<PlaneWall> &walls,
                                const ContactLaw &law, double time_step, Losses<Pack> &losses);
  Collected<std::int32_t> screen(const Particles &particles, const std::vector<PlaneWall> &walls) const;

  LoadSums loads;
};

} // namespace bergamo::dem
