#include "dem/force/follow.h"

namespace bergamo::dem
{
namespace
{

template <template <class> class State>
PairMotion<Pack> motion_of(const ContactStore<State> &store, const std::size_t block, const Particles &particles,
                           const double time_step)
{
  const std::int32_t *first = &store.first[block * pack_width], *second = &store.second[block * pack_width];
  return {particles, [=](const int lane) { return first[lane]; }, [=](const int lane) { return second[lane]; },
          time_step};
}

} // namespace

math::Mask<Pack> follow_block(ContactStore<ContactState> &store, const std::size_t block, const Particles &particles,
                              const ContactLaw &law, const double time_step, Losses<Pack> &losses)
{
  ContactState<Pack> &state = store.blocks[block];
  const PairMotion<Pack> motion = motion_of(store, block, particles, time_step);
  const Followed<Pack> followed = follow(state, motion, law, losses);
  store_resultants<Pack>(followed.force, state.point, motion.half_line,
                         [&](const int lane) { return &store.resultant[block * pack_width + lane]; });
  return followed.is_due;
}

math::Mask<Pack> follow_block(ContactStore<SphereContactState> &store, const std::size_t block,
                              const Particles &particles, const ContactLaw &law, const double time_step,
                              Losses<Pack> &losses)
{
  SphereContactState<Pack> &state = store.blocks[block];
  const PairMotion<Pack> motion = motion_of(store, block, particles, time_step);
  const auto radius = [&](const std::vector<std::int32_t> &grain)
  {
    return math::generate<Pack>([&](const int lane)
                                { return particles.bounding_radius[grain[block * pack_width + lane]]; });
  };
  const SphereGeometry<Pack> g(motion.half_line, radius(store.first), radius(store.second));
  const auto is_apart = g.overlap <= 0.;
  const Pack overlap = math::select(is_apart, state.overlap, g.overlap);

  ContactForces<Pack> forces = state.forces;
  forces.tangential = turn_force(forces.tangential, g.normal, motion.turn_about(g.normal));
  Losses<Pack> lost;
  advance_forces(law, g.normal, state.normal_stiffness, RoundStiffness<Pack>{state.tangential_stiffness},
                 state.reduced_mass, overlap, state.overlap, motion.displacement(g.point), time_step, forces, lost);
  losses.friction += math::select(is_apart, Pack(0.), Pack(state.weight * lost.friction));
  losses.viscous += math::select(is_apart, Pack(0.), Pack(state.weight * lost.viscous));
  store_resultants<Pack>(forces.on_body1(g.normal) * state.weight, g.point, motion.half_line,
                         [&](const int lane) { return &store.resultant[block * pack_width + lane]; });

  state.overlap = overlap;
  state.forces.normal = math::select(is_apart, state.forces.normal, forces.normal);
  state.forces.tangential = math::select<Pack>(is_apart, state.forces.tangential, forces.tangential);
  return is_apart;
}

} // namespace bergamo::dem
