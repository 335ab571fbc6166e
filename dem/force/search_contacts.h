#pragma once

#include "dem/force/contact_law.h"
#include "dem/force/contact_parameters.h"
#include "dem/force/contact_state.h"
#include "dem/force/contact_store.h"
#include "dem/force/load_sums.h"
#include "dem/force/pair_motion.h"
#include "dem/state/particles.h"

#include <cstdint>
#include <span>
#include <vector>

namespace bergamo::dem
{

/// A pair of grains whose contact is to be searched, and what came of it.
struct ContactSearch
{
  std::int32_t pair;          ///< of the Verlet list
  std::int32_t first, second; ///< grains
  Image image;                ///< of the second grain
  std::int32_t slot;          ///< of a contact that touched last step, else negative

  bool is_touching = false;
  bool is_undecided = false;
  double gap = 0.;          ///< lower bound where apart [m]
  Resultant resultant = {}; ///< where touching
};

/// A contact that a search found and that did not touch last step: it has no slot yet.
struct BegunContact
{
  std::size_t search; ///< which one it was
  ContactState<double> state;
};

/// What searches work on.
struct SearchContext
{
  const Particles &particles;
  const ContactLaw &law;
  const ContactParameters &parameters;
  double time_step;
  ContactStore<ContactState> &store; ///< contacts with a slot are brought to this step where they touch
  /// By pair: direction from which the search of a pair apart starts, zero for a pair never searched; takes what is
  /// found.
  std::vector<Eigen::Vector3f> &direction;
};

/// Searches one pack of pairs at the present poses. @param searches of different pairs
/// @param from, to which of them, at most pack_width; @param[in,out] losses with the weights [J]
/// @param[in,out] begun appended to
void search_contacts(std::span<ContactSearch> searches, std::size_t from, std::size_t to, const SearchContext &context,
                     ContactLosses &losses, std::vector<BegunContact> &begun);

} // namespace bergamo::dem
