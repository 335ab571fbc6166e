#pragma once

#include "dem/core/phase_times.h"
#include "dem/force/contact_parameters.h"
#include "dem/force/contact_state.h"
#include "dem/force/contact_store.h"
#include "dem/force/load_sums.h"
#include "dem/neighbour/verlet_list.h"
#include "dem/state/particles.h"

#include <cstdint>
#include <vector>

namespace bergamo::dem
{

struct SearchContext;

/// One touching contact as a reader sees it.
struct TouchingContact
{
  std::int32_t first, second; ///< grains
  ContactState<double> state;
  Vec3 branch;             ///< centre of body 2, in its image, minus centre of body 1 [m]
  Image image = own_image; ///< of body 2, see PeriodicCell
};

/// Contacts between grains: the Verlet list, and the history of the touching pairs in blocks of SIMD packs. A step
///  1. follows the touching contacts along the motion of their grains (dem/force/follow.h),
///  2. screens the pairs apart for those that may touch by now,
///  3. searches what either finds due (dem/force/search_contacts.h).
/// The same bits on any number of threads: work goes to threads in ranges, and what they find is taken up in order.
struct PairContacts
{
  VerletList list;
  std::vector<std::int32_t>
      slot; ///< of each pair in `grains` or, for two spheres, in `spheres`; `apart` if not touching
  /// A pair apart cannot touch before the motions of both grains add up to this [m]: it is left alone until then, which
  /// is exact. Infinite for a touching pair, which screening has not to look at.
  std::vector<double> rest_until;
  /// Direction that separates a pair apart, from which its next search starts; zero for a pair never searched.
  std::vector<Eigen::Vector3f> separating_direction;
  ContactStore<ContactState> grains;
  ContactStore<SphereContactState> spheres;
  ContactLosses losses;         ///< since the start [J]
  std::int64_t n_undecided = 0; ///< searches that ended without a decision, since the start
  std::int64_t n_searches = 0;  ///< since the start

  static constexpr std::int32_t apart = -1;

  std::vector<std::uint8_t> is_sphere; ///< by grain, since the list was renewed
  bool are_spheres(const std::int32_t i, const std::int32_t j) const { return is_sphere[i] && is_sphere[j]; }

  std::int32_t n_touching() const { return grains.size() + spheres.size(); }

  /// All touching contacts in the order of the pairs.
  std::vector<TouchingContact> touching(const Particles &particles) const;

  /// Replaces the list, keeping the history of every pair that stays. History of pairs that leave is booked as loss.
  void renew(VerletList new_list, const Particles &particles);

  /// Follows a new order of the particles, order[new] = old. The list must be renewed afterwards.
  void reorder(const std::vector<std::int32_t> &order, const Particles &reordered);

  /// Brings every pair to this step.
  void compute(const Particles &particles, const ContactLaw &law, const ContactParameters &parameters, double time_step,
               PhaseTimes &times);

  /// Adds what the contacts give to grain i, in a fixed order.
  void add_load(const std::size_t i, BodyLoad &load) const
  {
    grain_loads.add_load(i, load);
    sphere_loads.add_load(i, load);
  }

  /// Of all contacts at this step; zero without a periodic cell.
  Virial<double> virial() const
  {
    Virial<double> sum;
    grain_loads.add_virial(sum);
    sphere_loads.add_virial(sum);
    return sum;
  }

  /// Has every contact searched anew at the next step, e.g. after weights of grains have been changed.
  void refresh(const Particles &particles);

  /// Energy stored in all contacts [J].
  ContactEnergy total_energy() const;

private:
  struct Screened;
  struct NewContact;
  struct Found;
  struct DueLoad
  {
    Resultant resultant;
    bool is_touching = false;
  };

  Found search(const std::vector<std::int32_t> &due_slots, const std::vector<std::int32_t> &candidates,
               const SearchContext &context);
  void add_due_loads(const Particles &particles, const std::vector<std::int32_t> &due_slots);
  Screened screen(const Particles &particles);
  std::int32_t slot_near(std::int32_t pair) const;
  void list_bodies(std::size_t n_grains);
  void add_load_of(const Particles &particles, std::int32_t pair, const Resultant &resultant);

  LoadSums grain_loads, sphere_loads;
  std::vector<DueLoad> due_loads; // of one step; kept for its memory alone
};

} // namespace bergamo::dem
