#pragma once

#include "dem/force/contact_scene.h"
#include "dem/force/contact_store.h"
#include "dem/force/load_sums.h"
#include "dem/neighbour/verlet_list.h"

#include <cstdint>
#include <vector>

namespace bergamo::dem
{

/// A candidate pair whose contact is to be searched, and what came of it.
struct ContactSearch
{
  std::int32_t pair;                    ///< of the candidates
  std::int32_t first_part, second_part; ///< the second a wall where the kind says so
  std::int32_t first, second;           ///< particles that carry them
  Image image;                          ///< of the second
  std::int32_t slot;                    ///< of a contact that touched last step, else negative

  bool is_touching = false;
  bool is_undecided = false;
  double gap = 0.;          ///< lower bound where apart [m]
  Resultant resultant = {}; ///< where touching
};

/// A contact that a search found and that did not touch last step: it has no slot yet.
template <class Kind>
struct BegunContact
{
  std::size_t search; ///< which one it was
  typename Kind::State state;
};

/// What searches work on.
template <class Kind>
struct SearchContext
{
  const ContactScene &scene;
  typename Kind::Store &store; ///< contacts with a slot are brought to this step where they touch
  /// By pair: where the search of a pair apart starts; takes what is found.
  std::vector<typename Kind::Hint> &hint;
  const VerletList &list;                ///< all candidates
  const std::vector<std::int32_t> &slot; ///< of each in `store`, or negative
};

} // namespace bergamo::dem
