#pragma once

#include "dem/force/contact_set.h"
#include "dem/force/follow.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

/// One step of a ContactSet; for the sources of the kinds alone.
namespace bergamo::dem
{

template <class Kind>
void ContactSet<Kind>::compute(const ContactScene &scene, PhaseTimes &times)
{
  if (list.size() == 0)
    return; // history has ended at the renewal
  Stopwatch watch;
  const Particles &p = scene.particles;
  if (const bool are_wanted = !Kind::second_is_wall && p.are_weighted(); are_wanted != loads.has_transfers())
    loads.sum_transfers(are_wanted);
  list_bodies(scene.bodies());
  const std::vector<std::int32_t> due_slots = follow_all(store, loads, losses,
                                                         [&](const std::size_t block, Losses<Pack> &lost) {
                                                           return Kind::follow_block(store, loads, block, scene, lost);
                                                         })
                                                  .all();
  watch.lap(times.contacts);

  const std::vector<std::int32_t> candidates = screen(scene);
  watch.lap(times.screening);

  due_loads.resize(due_slots.size());
  const auto finish = [&](const Found &found)
  {
    list_bodies(scene.bodies());
    add_due_loads(p, due_slots);
    found.begun.for_each([&](const NewContact &c) { add_load_of(p, c.search, c.search.resultant); });
  };
  if constexpr (Kind::takes_over)
  {
    const Found ended = search(due_slots, {}, scene),
                begun = search({}, with_heirs(due_slots, ended, candidates), scene);
    take_up(ended, scene);
    take_up(begun, scene);
    finish(begun);
  }
  else
  {
    const Found found = search(due_slots, candidates, scene);
    take_up(found, scene);
    finish(found);
  }
  watch.lap(times.searches);
}

/// Candidates apart that may touch by now.
template <class Kind>
std::vector<std::int32_t> ContactSet<Kind>::screen(const ContactScene &scene)
{
  Collected<std::int32_t> candidates;
  const auto travelled = [&](const std::size_t pair)
  { return Kind::travelled(scene, list.first[pair], list.second[pair]); };
  const auto look_at = [&](const std::size_t part, const std::size_t pair)
  {
    const auto number = static_cast<std::int32_t>(pair);
    const double gap = Kind::least_gap(hint[pair], place_of(number, scene.particles), scene);
    if (gap > 0.)
      rest_until[pair] = travelled(pair) + gap;
    else
      candidates.of(part).push_back(number);
  };
  const std::size_t n_packs = list.size() / pack_width;
  parallel_ranges(n_packs, 64,
                  [&](const std::size_t part, const std::size_t begin, const std::size_t end)
                  {
                    for (std::size_t pack = begin; pack < end; ++pack)
                    {
                      const std::size_t pair = pack * pack_width;
                      const Pack motion = math::generate<Pack>([&](const int lane) { return travelled(pair + lane); });
                      const math::Mask<Pack> is_at_rest = motion < math::load(&rest_until[pair]);
                      if (!math::any(!is_at_rest))
                        continue;
                      for (int lane = 0; lane < pack_width; ++lane)
                        if (!math::lane(is_at_rest, lane))
                          look_at(part, pair + lane);
                    }
                  });
  for (std::size_t pair = n_packs * pack_width; pair < list.size(); ++pair)
    if (!(travelled(pair) < rest_until[pair]))
      look_at(most_parts() - 1, pair);
  return candidates.all();
}

/// Candidates, and the pairs apart of parts that had a contact searched: those that rested because of it, and all where
/// it has ended, which may take over from it.
template <class Kind>
std::vector<std::int32_t> ContactSet<Kind>::with_heirs(const std::vector<std::int32_t> &due_slots, const Found &found,
                                                       std::vector<std::int32_t> candidates) const
{
  const auto add = [&](const std::int32_t part, const auto &is_wanted)
  {
    for (auto pair = list.row[part]; pair < list.row[part + 1]; ++pair)
      if (slot[pair] == apart && is_wanted(pair))
        candidates.push_back(static_cast<std::int32_t>(pair));
  };
  for (const std::int32_t due : due_slots)
    add(list.first[store.pair[due]], [&](const auto pair) { return std::isinf(rest_until[pair]); });
  found.ended.for_each([&](const ContactSearch &s) { add(s.first_part, [](const auto) { return true; }); });
  std::sort(candidates.begin(), candidates.end());
  candidates.erase(std::unique(candidates.begin(), candidates.end()), candidates.end());
  return candidates;
}

/// Searches the contacts that are due, and then the candidates among the pairs apart.
template <class Kind>
typename ContactSet<Kind>::Found ContactSet<Kind>::search(const std::vector<std::int32_t> &due_slots,
                                                          const std::vector<std::int32_t> &candidates,
                                                          const ContactScene &scene)
{
  const std::size_t n = due_slots.size() + candidates.size(),
                    n_groups = (n + Kind::search_group - 1) / Kind::search_group;
  Found found;
  Collected<std::int64_t> undecided;
  std::vector<ContactLosses> group_losses(n_groups);
  const SearchContext<Kind> context{scene, store, hint, list, slot};
  parallel_ranges(n_groups, 1,
                  [&](const std::size_t part, const std::size_t begin, const std::size_t end)
                  {
                    std::vector<ContactSearch> searches;
                    std::vector<BegunContact<Kind>> begun;
                    for (std::size_t group = begin; group < end; ++group)
                    {
                      const std::size_t from = group * Kind::search_group, to = std::min(from + Kind::search_group, n);
                      searches.clear();
                      begun.clear();
                      for (std::size_t k = from; k < to; ++k)
                        searches.push_back(
                            place_of(k < due_slots.size() ? store.pair[due_slots[k]] : candidates[k - due_slots.size()],
                                     scene.particles));
                      Kind::search(searches, context, group_losses[group], begun);
                      for (std::size_t k = from; k < to; ++k)
                      {
                        const ContactSearch &s = searches[k - from];
                        if (s.is_undecided)
                          undecided.of(part).push_back(s.pair);
                        if (k < due_slots.size())
                          due_loads[k] = {s.resultant, s.is_touching};
                        if (s.is_touching)
                          continue;
                        rest_until[s.pair] = Kind::travelled(scene, s.first_part, s.second_part) + s.gap;
                        if (s.slot != apart)
                          found.ended.of(part).push_back(s);
                      }
                      for (const BegunContact<Kind> &c : begun)
                        found.begun.of(part).push_back({searches[c.search], c.state});
                    }
                  });
  for (const ContactLosses &lost : group_losses)
    losses += lost;
  n_searches += static_cast<std::int64_t>(n);
  undecided.for_each([&](const std::int64_t) { ++n_undecided; });
  return found;
}

/// Contacts that began or ended take and leave their slots one by one.
template <class Kind>
void ContactSet<Kind>::take_up(const Found &found, const ContactScene &scene)
{
  found.ended.for_each(
      [&](const ContactSearch &s)
      {
        forget(s.slot, Kind::end(s, store.get(s.slot), scene));
        slot[s.pair] = apart;
      });
  found.begun.for_each(
      [&](const NewContact &c)
      {
        const ContactSearch &s = c.search;
        slot[s.pair] = store.add({s.pair, s.first, s.second, s.image}, c.state, slot_near(s.pair));
        loads.take(slot[s.pair], s.first, Kind::body_of_second(s.second, scene.bodies()));
        rest_until[s.pair] = std::numeric_limits<double>::infinity();
      });
}

/// Takes a contact out of its slot. @param lost in its end
template <class Kind>
void ContactSet<Kind>::forget(const std::int32_t slot, const ContactLosses &lost)
{
  losses += lost;
  if constexpr (Kind::counts_friction)
    if (const std::int32_t feature = store.second[slot]; feature >= 0) // else removed
    {
      if (ended_friction.size() <= static_cast<std::size_t>(feature))
        ended_friction.resize(feature + 1, 0.);
      ended_friction[feature] += store.get(slot).friction_work + lost.friction;
    }
  store.remove(slot);
}

template <class Kind>
void ContactSet<Kind>::open_accounts()
{
  losses = {};
  ended_friction.clear();
  if constexpr (Kind::counts_friction)
    for (auto &block : store.blocks)
      block.friction_work = Pack(0.);
}

template <class Kind>
void ContactSet<Kind>::add_friction_work(const std::span<double> work) const requires Kind::counts_friction
{
  for (std::size_t feature = 0; feature < ended_friction.size(); ++feature)
    work[feature] += ended_friction[feature];
  for (std::size_t slot = 0; slot < store.n_slots(); ++slot)
    if (store.pair[slot] != store.free_slot && store.second[slot] >= 0)
      work[store.second[slot]] += store.get(static_cast<std::int32_t>(slot)).friction_work;
}

/// Adds what the searches of due contacts that stay have given, each chunk by one thread. @param due_slots ascending
template <class Kind>
void ContactSet<Kind>::add_due_loads(const Particles &p, const std::vector<std::int32_t> &due_slots)
{
  const auto first_of_chunk = [&](const std::size_t chunk)
  {
    return std::lower_bound(due_slots.begin(), due_slots.end(), static_cast<std::int32_t>(chunk * slots_per_chunk)) -
           due_slots.begin();
  };
  parallel_ranges(store.n_chunks(), 1,
                  [&](const std::size_t, const std::size_t begin, const std::size_t end)
                  {
                    const auto last = first_of_chunk(end);
                    for (auto k = first_of_chunk(begin); k < last; ++k)
                      if (due_loads[k].is_touching)
                        add_load_of(p, place_of(store.pair[due_slots[k]], p), due_loads[k].resultant);
                  });
}

template <class Kind>
void ContactSet<Kind>::add_load_of(const Particles &p, const ContactSearch &pair, const Resultant &resultant)
{
  const std::int32_t s = slot[pair.pair];
  loads.add(s, resultant);
  if (loads.has_transfers())
    if (const double weight = store.weight_of(s); weight > 0.)
      loads.add_transfer(s, resultant, p.weight[pair.first] / weight - 1., p.weight[pair.second] / weight - 1.);
  if (p.cell.is_periodic())
    loads.virial_of_slot(s).add(0.5 * p.branch(pair.first, pair.second, pair.image), p.cell.place[pair.image],
                                resultant.force);
}

/// Slot of a touching pair shortly before a pair in the list, mostly of the same particle; `apart` if there is none.
template <class Kind>
std::int32_t ContactSet<Kind>::slot_near(const std::int32_t pair) const
{
  for (std::int32_t k = pair - 1; k >= std::max(pair - Kind::near_reach, 0); --k)
    if (slot[k] != apart)
      return slot[k];
  return apart;
}

template <class Kind>
void ContactSet<Kind>::list_bodies(const BodyCount &count)
{
  if (loads.is_current())
    return;
  if constexpr (Kind::second_is_wall)
  {
    std::vector<std::int32_t> body;
    for (const std::int32_t second : store.second)
      body.push_back(Kind::body_of_second(second, count));
    loads.list_bodies(store.first, body, count.all());
  }
  else
    loads.list_bodies(store.first, store.second, count.particles);
}

template <class Kind>
ContactSearch ContactSet<Kind>::place_of(const std::int32_t pair, const Particles &p) const
{
  const std::int32_t first = list.first[pair], second = list.second[pair];
  const std::int32_t second_body = Kind::second_is_wall ? second : p.parts.particle[second];
  return {pair, first, second, p.parts.particle[first], second_body, list.image[pair], slot[pair]};
}

template <class Kind>
void ContactSet<Kind>::list_touching(const Particles &p, const std::int32_t law,
                                     std::vector<TouchingContact> &contacts) const
{
  for (std::size_t pair = 0; pair < list.size(); ++pair)
    if (slot[pair] != apart)
    {
      contacts.push_back(Kind::view(place_of(static_cast<std::int32_t>(pair), p), store.get(slot[pair]), p));
      contacts.back().law = law;
    }
}

template <class Kind>
ContactEnergy ContactSet<Kind>::total_energy() const
{
  ContactEnergy sum;
  for (std::size_t s = 0; s < store.n_slots(); ++s)
    if (store.pair[s] != store.free_slot)
    {
      const ContactEnergy e = stored_energy(store.get(static_cast<std::int32_t>(s)));
      sum.normal += e.normal;
      sum.tangential += e.tangential;
    }
  return sum;
}

} // namespace bergamo::dem
