#pragma once

#include "dem/core/parallel.h"
#include "dem/force/contact_store.h"
#include "dem/force/contact_turn.h"
#include "dem/force/load_sums.h"
#include "dem/force/pair_motion.h"

#include <algorithm>

namespace bergamo::dem
{

/// A contact after a step along the motion of its bodies.
template <class Real>
struct Followed
{
  math::Mask<Real> is_due; ///< to be searched anew
  Vector3<Real> force;     ///< on body 1 with the weight, zero where due [N]
};

/// Brings touching contacts to this step along the motion of their bodies, see ContactTurn. Due are those whose budget
/// is used up; and lost, left as the last step left them, those that may have come apart or turned too far in one step.
/// @param motion of the bodies, see PairMotion; @param[in,out] losses with the weights [J]
template <class Real, class Motion>
Followed<Real> follow(ContactState<Real> &state, const Motion &motion, const ContactLaw &law, Losses<Real> &losses)
{
  using math::select;
  TangentFrameOf<Real> frame;
  frame << state.axis, state.second_axis();
  const ContactTurn<Real> turn = motion.turn(state, frame);
  const TurnedFrame<Real> turned(state.normal, frame, turn);
  const Real overlap = state.overlap + turn.motion.approach, budget = state.budget - turn.wear;
  // Whatever is no number is lost: the search mends it, or its force stops the run.
  const math::Mask<Real> is_lost =
                             !(overlap > Real(0.)) ||
                             !(turn.tilt.squaredNorm() + turn.spin * turn.spin < Real(largest_turn * largest_turn)) ||
                             !(turn.wear < Real(largest_wear)),
                         is_due = is_lost || !(budget >= Real(0.));

  Losses<Real> lost;
  typename ContactState<Real>::Forces forces = state.forces;
  advance_forces(law, state.stiffness.normal, state.tangential_stiffness(), state.reduced_mass,
                 math::sqrt(select(is_lost, state.overlap, overlap)), math::sqrt(state.overlap), turn.motion,
                 motion.time_step, forces, lost);
  losses.friction += select(is_lost, Real(0.), Real(state.weight * lost.friction));
  losses.viscous += select(is_lost, Real(0.), Real(state.weight * lost.viscous));
  losses.quadrature += select(is_lost, Real(0.), Real(state.weight * lost.quadrature));

  const auto take = [&](auto &field, const auto &next) { field = select<Real>(is_lost, field, next); };
  take(state.normal, turned.normal);
  take(state.axis, turned.axis);
  take(state.point, Vector3<Real>(state.point + turn.shift));
  take(state.forces.tangential, forces.tangential);
  state.forces.normal = select(is_lost, state.forces.normal, forces.normal);
  state.overlap = select(is_lost, state.overlap, overlap);
  state.budget = select(is_lost, Real(state.lost), budget);
  return {is_due, select<Real>(is_due, Vector3<Real>(Real(0.), Real(0.), Real(0.)), state.force())};
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
