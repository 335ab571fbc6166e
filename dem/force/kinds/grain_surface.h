#pragma once

#include "dem/force/contact_set.h"
#include "dem/force/kinds/feature_separation.h"

#include <span>
#include <vector>

namespace bergamo::dem
{

/// Contacts of parts of particles with the features of surfaces, faces, edges and vertices; see ContactSet for what a
/// kind has to say, and dem/geometry/surface_contact.h for where they are. The weight of a contact is that of its
/// particle times the index of its place. Where a part goes from one feature to the next, the new contact takes over
/// the force of friction from the old one; and where a bend makes two places of one, both new ones begin with it, so
/// that they add nothing.
struct GrainSurface
{
  using State = SurfaceContactState<double>;
  using Store = ContactStore<SurfaceContactState>;
  using Hint = FeatureSeparation;
  static Hint no_hint() { return {}; }
  static double least_gap(const Hint &separation, const ContactSearch &pair, const ContactScene &scene)
  {
    return separation.least_gap(pair, scene);
  }

  static constexpr bool second_is_wall = true;
  static constexpr bool takes_over = true;
  static constexpr bool counts_friction = true;
  static constexpr bool is_interleaved = false;
  static constexpr std::size_t search_group = 16;
  static constexpr std::int32_t near_reach = 16;

  static std::int32_t body_of_second(std::int32_t, const BodyCount &count)
  {
    return static_cast<std::int32_t>(count.particles + count.walls);
  }

  static double travelled(const ContactScene &scene, std::int32_t part, std::int32_t)
  {
    return scene.particles.parts.motion[part] + scene.surface_motion;
  }

  static math::Mask<Pack> follow_block(Store &store, LoadSums &loads, std::size_t block, const ContactScene &scene,
                                       Losses<Pack> &losses);
  static void search(std::span<ContactSearch> searches, const SearchContext<GrainSurface> &context,
                     ContactLosses &losses, std::vector<BegunContact<GrainSurface>> &begun);
  static ContactLosses end(const ContactSearch &search, const State &state, const ContactScene &scene);
  static void exchange_bodies(State &) {}
  static void exchange_bodies(Hint &) {}
  static void refresh(Store &store, const Particles &particles);
  static TouchingContact view(const ContactSearch &place, const State &state, const Particles &particles);
};

extern template class ContactSet<GrainSurface>;

} // namespace bergamo::dem
