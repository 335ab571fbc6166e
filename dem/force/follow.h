#pragma once

#include "dem/core/parallel.h"
#include "dem/force/contact_state.h"
#include "dem/force/contact_store.h"
#include "dem/force/load_sums.h"
#include "dem/force/pair_motion.h"

#include <algorithm>

namespace bergamo::dem
{

/// A contact after a step along the rigid motion of its bodies.
template <class Real>
struct Followed
{
  math::Mask<Real> is_due; ///< to be searched anew: its state is left as last step left it
  Vector3<Real> force;     ///< on body 1 with the weight, zero where due [N]
};

/// Brings touching contacts to this step along the rigid motion of their bodies, with the normal held. Due are those
/// whose motion budget is used up and those that may have come apart.
/// @param motion of the bodies, see PairMotion; @param[in,out] losses with the weights [J]
template <class Real, class Motion>
Followed<Real> follow(ContactState<Real> &state, const Motion &motion, const ContactLaw &law, Losses<Real> &losses)
{
  constexpr double largest_spin = 0.1; // that a force is turned by at once [rad]
  ContactState<Real> next = state;
  const Vector3<Real> displacement = motion.displacement(state.point);
  next.overlap = state.overlap - state.normal.dot(displacement);
  next.budget = state.budget - motion.bound(displacement, state.radius);
  next.spin = state.spin + motion.turn_about(state.normal);
  // Whatever is no number is due: the search mends it, or its force stops the run.
  const math::Mask<Real> is_due =
      !(next.budget >= Real(0.)) || !(next.overlap > Real(0.)) || !(math::abs(next.spin) < Real(largest_spin));
  next.overlap = math::select(is_due, state.overlap, next.overlap);

  Losses<Real> lost;
  const Vector3<Real> force = advance_contact(next, law, state.overlap, displacement, motion.time_step, lost);
  losses.friction += math::select(is_due, Real(0.), lost.friction);
  losses.viscous += math::select(is_due, Real(0.), lost.viscous);

  state.overlap = next.overlap;
  state.budget = math::select(is_due, state.budget, next.budget);
  state.spin = math::select(is_due, state.spin, next.spin);
  state.forces.normal = math::select(is_due, state.forces.normal, next.forces.normal);
  state.forces.tangential = math::select<Real>(is_due, state.forces.tangential, next.forces.tangential);
  return {is_due, math::select<Real>(is_due, Vector3<Real>(Real(0.), Real(0.), Real(0.)), force)};
}

/// Follows one block of contacts and adds what they give. @return lanes to be searched anew, which add nothing
math::Mask<Pack> follow_block(ContactStore<ContactState> &store, LoadSums &loads, std::size_t block,
                              const Particles &particles, const ContactLaw &law, double time_step,
                              Losses<Pack> &losses);

/// The same for contacts of spheres. @return lanes that came apart
math::Mask<Pack> follow_block(ContactStore<SphereContactState> &store, LoadSums &loads, std::size_t block,
                              const Particles &particles, const ContactLaw &law, double time_step,
                              Losses<Pack> &losses);

/// Calls follow(block, losses) for every block of a store, which returns a mask of lanes and adds to the loads.
/// @param[out] loads of which all sums start at zero; @param[in,out] losses their sum, by chunks [J]
/// @return slots of the lanes masked, in order
template <class Store, class Follow>
Collected<std::int32_t> follow_all(const Store &store, LoadSums &loads, ContactLosses &losses, Follow &&follow)
{
  constexpr std::size_t blocks_per_chunk = slots_per_chunk / pack_width;
  Collected<std::int32_t> masked;
  std::vector<ContactLosses> chunk_losses(store.n_chunks());
  parallel_ranges(store.n_chunks(), 1,
                  [&](const std::size_t part, const std::size_t begin, const std::size_t end)
                  {
                    for (std::size_t chunk = begin; chunk < end; ++chunk)
                    {
                      loads.start(chunk);
                      Losses<Pack> lost;
                      const std::size_t last = std::min((chunk + 1) * blocks_per_chunk, store.n_blocks());
                      for (std::size_t block = chunk * blocks_per_chunk; block < last; ++block)
                      {
                        const math::Mask<Pack> mask = follow(block, lost);
                        if (math::any(mask))
                          for (int lane = 0; lane < pack_width; ++lane)
                          {
                            const auto slot = static_cast<std::int32_t>(block * pack_width + lane);
                            if (math::lane(mask, lane) && store.pair[slot] != store.free_slot)
                              masked.of(part).push_back(slot);
                          }
                      }
                      chunk_losses[chunk] += lost;
                    }
                  });
  for (const ContactLosses &lost : chunk_losses)
    losses += lost;
  return masked;
}

} // namespace bergamo::dem
