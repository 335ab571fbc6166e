#pragma once

#include "dem/force/contact_set.h"

#include <span>
#include <vector>

namespace bergamo::dem
{

/// Contacts of parts of particles with plane walls; see ContactSet for what a kind has to say. Body 1 is the particle,
/// body 2 the wall: the contact normal is minus the wall's normal, so that nothing is searched for.
struct GrainPlane
{
  using State = ContactState<double>;
  using Store = ContactStore<ContactState>;
  struct Hint
  {
  };
  static Hint no_hint() { return {}; }
  static double least_gap(const Hint &, const ContactSearch &, const ContactScene &) { return 0.; } // unknown

  static constexpr bool second_is_wall = true;
  static constexpr bool takes_over = false;
  static constexpr bool counts_friction = false;
  static constexpr bool is_interleaved = false; // all contacts of a wall add to the same load
  static constexpr std::size_t search_group = 16;
  static constexpr std::int32_t near_reach = 1;

  static std::int32_t body_of_second(const std::int32_t wall, const BodyCount &count)
  {
    return static_cast<std::int32_t>(count.particles) + wall;
  }

  static double travelled(const ContactScene &scene, std::int32_t part, std::int32_t wall)
  {
    return scene.particles.parts.motion[part] + scene.walls[wall].motion;
  }

  static math::Mask<Pack> follow_block(Store &store, LoadSums &loads, std::size_t block, const ContactScene &scene,
                                       Losses<Pack> &losses);
  static void search(std::span<ContactSearch> searches, const SearchContext<GrainPlane> &context, ContactLosses &losses,
                     std::vector<BegunContact<GrainPlane>> &begun);
  static ContactLosses end(const ContactSearch &search, const State &state, const ContactScene &scene);
  static void exchange_bodies(State &) {}
  static void exchange_bodies(Hint &) {}
  static void refresh(Store &store, const Particles &particles);
  static TouchingContact view(const ContactSearch &place, const State &state, const Particles &particles);
};

extern template class ContactSet<GrainPlane>;

} // namespace bergamo::dem
