#pragma once

#include "dem/core/parallel.h"
#include "dem/core/phase_times.h"
#include "dem/force/contact_search.h"
#include "dem/force/load_sums.h"
#include "dem/force/touching_contact.h"
#include "dem/neighbour/verlet_list.h"

#include <cstdint>
#include <span>
#include <vector>

namespace bergamo::dem
{

struct CellCopies;

/// New place of a part that was removed.
inline constexpr std::int32_t removed_part = -1;

/// Contacts of one kind: its candidates, and the history of those that touch in blocks of SIMD packs. A step
///  1. follows the touching contacts along the motion of their bodies,
///  2. screens the candidates apart for those that may touch by now,
///  3. searches what either finds due, and gives or takes slots where contacts begin or end.
/// The same bits on any number of threads: work goes to threads in ranges, and what they find is taken up in order.
///
/// A kind says what a contact remembers (State, Store), where a search starts (Hint), how far its bodies have moved
/// (travelled), what is left of the gap of a pair apart (least_gap), how a block is followed, a group of pairs
/// searched, a contact ended, seen from the other body, searched anew and shown to a reader; whether body 2 is no part,
/// and which body then takes the loads; whether new contacts take over from others of the same part, so that they are
/// searched after those; and whether the work of friction is counted by contact. See dem/force/kinds, and Contacts,
/// which lists them all.
template <class Kind>
class ContactSet
{
public:
  using State = typename Kind::State;

  static constexpr std::int32_t apart = -1;

  /// Replaces the candidates, keeping the history of every pair that stays. History of pairs that leave is booked as
  /// loss. @param found rows by part; the second of a pair is a part, or a wall
  /// @param sought by part: pairs without one of these stay, and bodies are still the same; none given, all are
  /// replaced
  void renew(const VerletList &found, const Particles &particles, std::span<const std::uint8_t> sought);

  /// Follows a new order of the parts, new_part[old] or removed_part; history with a removed one is booked as loss. The
  /// candidates must be renewed afterwards. @param n_parts that stay
  void reorder(const std::vector<std::int32_t> &new_part, std::size_t n_parts);

  /// Follows the parts of a periodic cell to its copies as repeated() puts them: each has the contacts of the cell,
  /// with their history. The candidates must be renewed afterwards. @param n_parts of the cell
  void repeat(const CellCopies &copies, std::size_t n_parts);

  /// Drops all contacts of n walls or features at the next renewal, whose history is then booked as loss; later ones
  /// move up.
  void remove_walls(std::int32_t first, std::int32_t n) requires Kind::second_is_wall;

  /// Brings every contact to this step.
  void compute(const ContactScene &scene, PhaseTimes &times);

  /// What the contacts give to their bodies: particles first, walls after them.
  const LoadSums &load_sums() const { return loads; }

  /// Adds the virial of all contacts at this step.
  void add_virial(Virial<double> &sum) const { loads.add_virial(sum); }

  /// Counts losses from now on.
  void open_accounts();

  /// Adds what friction has done at each wall or feature since the accounts were opened, which is all of
  /// `losses.friction` [J]. @param[in,out] work by feature
  void add_friction_work(std::span<double> work) const requires Kind::counts_friction;

  /// Has every contact searched anew at the next step, e.g. after weights have been changed.
  void refresh(const Particles &particles) { Kind::refresh(store, particles); }

  /// Appends all touching contacts in the order of the candidates. @param law what they carry as theirs
  void list_touching(const Particles &particles, std::int32_t law, std::vector<TouchingContact> &contacts) const;

  /// Energy stored in all contacts [J].
  ContactEnergy total_energy() const;

  /// Whether it has candidates, or had any.
  bool was_used() const { return list.size() > 0 || n_searches > 0; }

  std::size_t size() const { return list.size(); }         ///< candidates
  std::int32_t n_touching() const { return store.size(); } ///< contacts
  const VerletList &candidates() const { return list; }
  const typename Kind::Store &touching() const { return store; }

  ContactLosses losses;         ///< since the start [J]
  std::int64_t n_undecided = 0; ///< searches that ended without a decision, since the start
  std::int64_t n_searches = 0;  ///< since the start

  /// All that a step depends on; see dem/core/state.h.
  template <class Self, class Visit>
  static void visit_state(Self &self, Visit &visit)
  {
    visit("row", self.list.row);
    visit("first", self.list.first);
    visit("second", self.list.second);
    visit("image", self.list.image);
    visit("slot", self.slot);
    visit("rest_until", self.rest_until);
    visit("hint", self.hint);
    visit("touching", self.store);
    visit("friction_loss", self.losses.friction);
    visit("viscous_loss", self.losses.viscous);
    visit("curvature_work", self.losses.curvature);
    visit("search_work", self.losses.search);
    visit("quadrature_work", self.losses.quadrature);
    if constexpr (Kind::counts_friction)
      visit("ended_friction", self.ended_friction);
    visit("n_undecided", self.n_undecided);
    visit("n_searches", self.n_searches);
  }

private:
  struct NewContact
  {
    ContactSearch search;
    State state;
  };
  struct Found // what searches change, in their order; contacts that stay are in their slots, their loads in due_loads
  {
    Collected<ContactSearch> ended;
    Collected<NewContact> begun;
  };
  struct DueLoad
  {
    Resultant resultant;
    bool is_touching = false;
  };

  ContactSearch place_of(std::int32_t pair, const Particles &particles) const;
  void list_bodies(const BodyCount &count);
  std::vector<std::int32_t> screen(const ContactScene &scene);
  std::vector<std::int32_t> with_heirs(const std::vector<std::int32_t> &due_slots, const Found &found,
                                       std::vector<std::int32_t> candidates) const;
  Found search(const std::vector<std::int32_t> &due_slots, const std::vector<std::int32_t> &candidates,
               const ContactScene &scene);
  void take_up(const Found &found, const ContactScene &scene);
  void add_due_loads(const Particles &particles, const std::vector<std::int32_t> &due_slots);
  void add_load_of(const Particles &particles, const ContactSearch &pair, const Resultant &resultant);
  std::int32_t slot_near(std::int32_t pair) const;
  void forget(std::int32_t slot, const ContactLosses &lost);
  std::vector<std::int32_t> take_candidates(const VerletList &found, std::span<const std::uint8_t> sought);
  bool is_scattered() const;
  void compact(const Particles &particles);
  VerletList list;
  std::vector<std::int32_t> slot; ///< of each candidate in `store`, or `apart`
  /// A pair apart cannot touch before the motions of both bodies add up to this [m]: it is left alone until then, which
  /// is exact. Infinite for a touching pair, which screening has not to look at, and for one that a contact of its part
  /// guards until that is searched.
  std::vector<double> rest_until;
  std::vector<typename Kind::Hint> hint;
  typename Kind::Store store;
  std::vector<double> ended_friction; // of contacts that ended, by feature, as far as there were any [J]
  LoadSums loads;
  std::vector<DueLoad> due_loads; // of one step; kept for its memory alone
};

} // namespace bergamo::dem
