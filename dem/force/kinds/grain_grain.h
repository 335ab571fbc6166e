#pragma once

#include "dem/force/contact_set.h"
#include "dem/force/kinds/between_parts.h"
#include "dem/force/separation.h"

#include <span>
#include <vector>

namespace bergamo::dem
{

/// Contacts between parts of particles of any shape; see ContactSet for what a kind has to say. Followed along the
/// rigid motion (dem/force/follow.h), searched in packs by Newton's method (dem/force/search_contacts.h).
struct GrainGrain : BetweenParts
{
  using State = ContactState<double>;
  using Store = ContactStore<ContactState>;
  using Hint = Separation;
  static Hint no_hint() { return {}; }
  static double least_gap(const Hint &separation, const ContactSearch &pair, const ContactScene &scene)
  {
    return separation.least_gap(pair, scene);
  }

  static constexpr std::size_t search_group = 64;

  static math::Mask<Pack> follow_block(Store &store, LoadSums &loads, std::size_t block, const ContactScene &scene,
                                       Losses<Pack> &losses);
  static void search(std::span<ContactSearch> searches, const SearchContext<GrainGrain> &context, ContactLosses &losses,
                     std::vector<BegunContact<GrainGrain>> &begun);
  static ContactLosses end(const ContactSearch &search, const State &state, const ContactScene &scene);
  static void exchange_bodies(State &state);
  static void exchange_bodies(Hint &separation) { separation.exchange_bodies(); }
  static void refresh(Store &store, const Particles &particles);
  static TouchingContact view(const ContactSearch &place, const State &state, const Particles &particles);
};

extern template class ContactSet<GrainGrain>;

} // namespace bergamo::dem
