#include "dem/force/kinds/grain_grain.h"

#include "dem/force/follow.h"
#include "dem/force/search_contacts.h"
#include "dem/force/searched_contact.h"

#include <utility>

namespace bergamo::dem
{

math::Mask<Pack> GrainGrain::follow_block(Store &store, LoadSums &loads, const std::size_t block,
                                          const ContactScene &scene, Losses<Pack> &losses)
{
  return dem::follow_block(store, loads, block, scene.particles, scene.law, scene.time_step, losses);
}

void GrainGrain::search(const std::span<ContactSearch> searches, const SearchContext<GrainGrain> &context,
                        ContactLosses &losses, std::vector<BegunContact<GrainGrain>> &begun)
{
  search_contacts(searches, context, losses, begun);
}

ContactLosses GrainGrain::end(const ContactSearch &search, const State &state, const ContactScene &scene)
{
  return end_of(state, motion_of_pair(search, scene));
}

void GrainGrain::exchange_bodies(State &s)
{
  // The axis stays, the second one turns around.
  s.normal = -s.normal;
  s.forces.tangential[0] = -s.forces.tangential[0];
  s.radii1.r12 = -s.radii1.r12;
  s.radii2.r12 = -s.radii2.r12;
  std::swap(s.radii1, s.radii2);
  s.wear1.swap(s.wear2);
}

void GrainGrain::refresh(Store &store, const Particles &)
{
  search_all_anew(store);
}

TouchingContact GrainGrain::view(const ContactSearch &place, const State &state, const Particles &particles)
{
  return {place.first, place.second, view_of(state), particles.branch(place.first, place.second, place.image),
          place.image};
}

} // namespace bergamo::dem
