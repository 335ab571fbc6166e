#pragma once

#include "dem/force/candidates.h"
#include "dem/force/kinds/grain_grain.h"
#include "dem/force/kinds/grain_plane.h"
#include "dem/force/kinds/grain_surface.h"
#include "dem/force/kinds/sphere_sphere.h"
#include "dem/state/material.h"

#include <cstdint>
#include <string>
#include <vector>

namespace bergamo::dem
{

/// Laws of all pairs of materials, by MaterialTable::pair_number().
std::vector<ContactLaw> contact_laws(const MaterialTable &materials);

/// What a step's contacts depend on beside the bodies.
struct ContactStep
{
  const std::vector<ContactLaw> &laws; ///< by MaterialTable::pair_number()
  const ContactParameters &parameters;
  double time_step; ///< of the drift that led here [s]
  std::span<const Surface> surfaces = {};
};

/// All contacts of a simulation: the register of their kinds. Each kind has a set for each pair of materials, so that
/// the contacts of a block share their law.
class Contacts
{
public:
  explicit Contacts(std::int32_t n_material_pairs = 1);

  /// The kinds, in the order in which they are computed and summed: the one place that lists them.
  template <class Self, class Visit>
  static void for_each_kind(Self &self, Visit &&visit)
  {
    visit("grain_grain", self.grain_grain);
    visit("sphere_sphere", self.sphere_sphere);
    visit("grain_plane", self.grain_plane);
    visit("grain_surface", self.grain_surface);
  }

  /// Calls visit(set, number of the pair of materials) for the sets of all kinds.
  template <class Self, class Visit>
  static void for_each_set(Self &self, Visit &&visit)
  {
    for_each_kind(self,
                  [&](const char *, auto &sets)
                  {
                    for (std::size_t law = 0; law < sets.size(); ++law)
                      visit(sets[law], static_cast<std::int32_t>(law));
                  });
  }

  /// Looks for candidates anew; the history of pairs that stay is kept, and so are all pairs without a part sought.
  void renew(const Particles &particles, const std::vector<PlaneWall> &walls, std::span<const Surface> surfaces,
             CandidateSearch search);

  /// Follows a new order of the parts that stay, order[new] = old. The candidates must be renewed afterwards.
  /// @param n_old parts before
  void reorder(const std::vector<std::int32_t> &part_order, std::size_t n_old);

  /// Gives the copies of a periodic cell the contacts that it has, see ContactSet::repeat(). Losses stay as they are.
  /// @param n_parts of the cell
  void repeat(const CellCopies &copies, std::size_t n_parts);

  /// Drops all contacts of one wall at the next renewal; later walls move up by one.
  void remove_wall(std::int32_t wall);

  /// The same of features, counted as feature_of() does.
  void remove_features(std::int32_t first, std::int32_t n);

  /// Brings every contact to this step.
  void compute(const Particles &particles, const std::vector<PlaneWall> &walls, const ContactStep &step,
               PhaseTimes &times);

  /// What the contacts give to their bodies, particles first and walls after them, in the order in which it is to be
  /// summed; sets without contacts are left out.
  std::vector<const LoadSums *> load_sums() const;

  /// Of all contacts between particles at this step; zero without a periodic cell.
  Virial<double> virial() const;

  /// Has every contact searched anew at the next step, e.g. after weights have been changed.
  void refresh(const Particles &particles);

  /// Contacts between particles, and with walls and surfaces, in a fixed order.
  std::vector<TouchingContact> touching(const Particles &particles) const;
  std::vector<TouchingContact> touching_walls(const Particles &particles) const;

  ContactEnergy total_energy() const; ///< stored in all contacts [J]
  ContactLosses losses() const;       ///< since the accounts were opened [J]
  void open_accounts();               ///< counts losses from now on

  /// Friction's work at each feature of the surfaces since the accounts were opened, with the weights; what contacts
  /// have lost in their end counts [J]. @param n_features of all surfaces, counted as feature_of() does
  std::vector<double> friction_work(std::size_t n_features) const;

  std::int32_t n_touching() const;       ///< contacts between particles
  std::int32_t n_touching_walls() const; ///< contacts with walls and surfaces
  std::int64_t n_candidates() const;     ///< pairs of parts near one another
  std::int64_t n_searches() const;       ///< since the start
  std::int64_t n_undecided() const;      ///< searches that ended without a decision, since the start

  /// All that a step depends on; see dem/core/state.h. Sets that never had a candidate are left out: snapshots of many
  /// materials stay small. Read into contacts that have none yet.
  template <class Self, class Visit>
  static void visit_state(Self &self, Visit &visit)
  {
    for_each_kind(self,
                  [&](const std::string &kind, auto &sets)
                  {
                    std::vector<std::int64_t> used;
                    for (std::size_t law = 0; law < sets.size(); ++law)
                      if (sets[law].was_used())
                        used.push_back(static_cast<std::int64_t>(law));
                    visit((kind + "_laws").c_str(), used);
                    for (const std::int64_t law : used)
                      visit((kind + '_' + std::to_string(law)).c_str(), sets.at(law));
                  });
  }

  std::vector<ContactSet<GrainGrain>> grain_grain;
  std::vector<ContactSet<SphereSphere>> sphere_sphere;
  std::vector<ContactSet<GrainPlane>> grain_plane;
  std::vector<ContactSet<GrainSurface>> grain_surface;

private:
  std::shared_ptr<const FaceTree> faces; // kept while the surfaces rest; follows from them alone
};

} // namespace bergamo::dem
