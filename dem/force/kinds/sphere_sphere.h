#pragma once

#include "dem/force/contact_set.h"
#include "dem/force/kinds/between_parts.h"

#include <span>
#include <vector>

namespace bergamo::dem
{

/// Contacts between spheres about the centres of their particles, whose geometry is exact at every step; see
/// ContactSet for what a kind has to say.
struct SphereSphere : BetweenParts
{
  using State = SphereContactState<double>;
  using Store = ContactStore<SphereContactState>;
  struct Hint
  {
  };
  static Hint no_hint() { return {}; }
  static double least_gap(const Hint &, const ContactSearch &, const ContactScene &) { return 0.; } // unknown

  static constexpr std::size_t search_group = 16;

  static math::Mask<Pack> follow_block(Store &store, LoadSums &loads, std::size_t block, const ContactScene &scene,
                                       Losses<Pack> &losses);
  static void search(std::span<ContactSearch> searches, const SearchContext<SphereSphere> &context,
                     ContactLosses &losses, std::vector<BegunContact<SphereSphere>> &begun);
  static ContactLosses end(const ContactSearch &search, const State &state, const ContactScene &scene);
  static void exchange_bodies(State &state);
  static void exchange_bodies(Hint &) {}
  static void refresh(Store &store, const Particles &particles);
  static TouchingContact view(const ContactSearch &place, const State &state, const Particles &particles);
};

extern template class ContactSet<SphereSphere>;

} // namespace bergamo::dem
