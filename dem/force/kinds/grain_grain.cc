#include "dem/force/kinds/grain_grain.h"

#include "dem/force/follow.h"
#include "dem/force/search_contacts.h"

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
  const PairMotion<double> motion = motion_of_pair(search, scene);
  return separate(state, state.normal, motion.displacement(state.point));
}

void GrainGrain::exchange_bodies(State &s)
{
  s.normal = -s.normal;
  s.forces.tangential = -s.forces.tangential;
  s.spin = -s.spin; // about the normal
}

void GrainGrain::refresh(Store &store, const Particles &)
{
  search_all_anew(store);
}

TouchingContact GrainGrain::view(const ContactSearch &place, const State &state, const Particles &particles)
{
  return {place.first, place.second, state, particles.branch(place.first, place.second, place.image), place.image};
}

} // namespace bergamo::dem
