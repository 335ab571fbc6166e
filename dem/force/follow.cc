#include "dem/force/follow.h"

#include "dem/force/follow_spheres.h"

#include <array>

namespace bergamo::dem
{
namespace
{

template <template <class> class State>
PairMotion<Pack> motion_of(const ContactStore<State> &store, const std::size_t block, const Particles &particles,
                           const double time_step)
{
  const std::int32_t *first = &store.first[block * pack_width], *second = &store.second[block * pack_width];
  const Image *image = &store.image[block * pack_width];
  return {particles, [=](const int lane) { return first[lane]; }, [=](const int lane) { return second[lane]; },
          [=](const int lane) { return image[lane]; }, time_step};
}

/// Shifts of the second grains' images [m].
template <template <class> class State>
Vector3<Pack> shift_of_block(const ContactStore<State> &store, const std::size_t block, const Particles &p)
{
  return math::gather_vectors<Pack>([&](const int lane) -> const Vec3 &
                                    { return p.cell.place[store.image[block * pack_width + lane]]; });
}

constexpr std::size_t blocks_ahead = 2;

/// Fetches ahead what a block will follow. Inlined by force: g++ 12 leaves out a call that does nothing but fetch.
template <template <class> class State>
BERGAMO_INLINE void prefetch(const ContactStore<State> &store, const std::size_t block, const Particles &p)
{
  if (block >= store.n_blocks())
    return;
  store.prefetch(block);
  for (int lane = 0; lane < pack_width; ++lane)
  {
    const std::int32_t j = store.second[block * pack_width + lane];
    __builtin_prefetch(&p.position[j]);
    __builtin_prefetch(&p.drift_velocity[j]);
    __builtin_prefetch(&p.angular_velocity[j]);
  }
}

/// What weights that differ make of a block's contacts, see Particles::transfer_force. Blocks within one weight add
/// none.
template <template <class> class State>
void add_transfers(LoadSums &loads, const ContactStore<State> &store, const std::size_t block, const Particles &p,
                   const std::array<Vector3<Pack>, 3> &load)
{
  for (int lane = 0; lane < pack_width; ++lane)
  {
    const auto slot = static_cast<std::int32_t>(block * pack_width + lane);
    const double weight1 = p.weight[store.first[slot]], weight2 = p.weight[store.second[slot]];
    if (weight1 == weight2)
      continue;
    if (const double weight = math::lane(store.blocks[block].weight, lane); weight > 0.)
      loads.add_transfer(
          slot, {math::lane<Pack>(load[0], lane), math::lane<Pack>(load[1], lane), math::lane<Pack>(load[2], lane)},
          weight1 / weight - 1., weight2 / weight - 1.);
  }
}

} // namespace

math::Mask<Pack> follow_block(ContactStore<ContactState> &store, LoadSums &loads, const std::size_t block,
                              const Particles &particles, const ContactLaw &law, const double time_step,
                              Losses<Pack> &losses)
{
  prefetch(store, block + blocks_ahead, particles);
  ContactState<Pack> &state = store.blocks[block];
  const PairMotion<Pack> motion = motion_of(store, block, particles, time_step);
  const Followed<Pack> followed = follow(state, motion, law, losses);
  const Vector3<Pack> &force = followed.force;
  const Vector3<Pack> torque1 = (motion.half_line + state.point).cross(force),
                      torque2 = (motion.half_line - state.point).cross(force);
  loads.add(block, force, torque1, torque2);
  if (loads.has_transfers())
    add_transfers(loads, store, block, particles, {force, torque1, torque2});
  if (particles.cell.is_periodic())
    loads.virial_of_block(block).add(motion.half_line, shift_of_block(store, block, particles), force);
  return followed.is_due;
}

math::Mask<Pack> follow_block(ContactStore<SphereContactState> &store, LoadSums &loads, const std::size_t block,
                              const Particles &particles, const ContactLaw &law, const double time_step,
                              Losses<Pack> &losses)
{
  prefetch(store, block + blocks_ahead, particles);
  const PairMotion<Pack> motion = motion_of(store, block, particles, time_step);
  const FollowedSpheres<Pack> followed = follow(store.blocks[block], motion, law, losses);
  loads.add(block, followed.force, followed.torque1, followed.torque2);
  if (loads.has_transfers())
    add_transfers(loads, store, block, particles, {followed.force, followed.torque1, followed.torque2});
  if (particles.cell.is_periodic())
    loads.virial_of_block(block).add(motion.half_line, shift_of_block(store, block, particles), followed.force);
  return followed.is_apart;
}

} // namespace bergamo::dem
