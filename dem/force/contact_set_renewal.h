#pragma once

#include "dem/core/parallel_sum.h"
#include "dem/force/contact_set.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

/// How a ContactSet follows new candidates and a new order; for the sources of the kinds alone.
namespace bergamo::dem
{

/// Slot of the k-th of n contacts. Contacts next to each other share a grain; so that the lanes of a block do not wait
/// for one another when they add to its load, such go to the same lane of consecutive blocks.
inline std::int32_t interleaved_slot(const std::size_t k, const std::size_t n)
{
  constexpr std::size_t square = pack_width * pack_width;
  const std::size_t begin = k / square * square, place = k - begin;
  if (begin + square > n)
    return static_cast<std::int32_t>(k);
  return static_cast<std::int32_t>(begin + place % pack_width * pack_width + place / pack_width);
}

template <class Kind>
void ContactSet<Kind>::renew(const VerletList &found, const Particles &particles,
                             const std::span<const std::uint8_t> sought)
{
  for (const std::int32_t left : take_candidates(found, sought)) // by slot
    forget(left, release(store.get(left)));
  if (sought.empty() || is_scattered())
  {
    compact(particles);
    return;
  }
  parallel_for(list.size(),
               [&](const std::size_t pair)
               {
                 if (slot[pair] != apart)
                   store.pair[slot[pair]] = static_cast<std::int32_t>(pair);
               });
}

/// Merges the candidates found with those that stay. @return slots of the pairs that leave, in the order of the pairs
template <class Kind>
std::vector<std::int32_t> ContactSet<Kind>::take_candidates(const VerletList &found,
                                                            const std::span<const std::uint8_t> sought)
{
  if (list.size() == 0 && found.size() == 0) // as many sets of many materials
  {
    list.row = found.row;
    return {};
  }
  const std::size_t n_rows = found.row.empty() ? 0 : found.row.size() - 1;
  const auto stays = [&](const std::size_t pair)
  {
    if (sought.empty() || sought[list.first[pair]])
      return false;
    return Kind::second_is_wall || !sought[list.second[pair]];
  };
  const auto old_row = [&](const std::size_t i) // parts that came have none
  { return i + 1 < list.row.size() ? std::pair(list.row[i], list.row[i + 1]) : std::pair(0, 0); };

  VerletList next;
  next.row.resize(n_rows + 1);
  parallel_for(n_rows,
               [&](const std::size_t i)
               {
                 std::int32_t n = found.row[i + 1] - found.row[i];
                 const auto [begin, end] = old_row(i);
                 for (auto pair = begin; pair < end; ++pair)
                   n += stays(pair);
                 next.row[i] = n;
               });
  exclusive_sum(next.row);
  const std::size_t n_pairs = next.row.back();
  next.first.resize(n_pairs);
  next.second.resize(n_pairs);
  next.image.resize(n_pairs);
  std::vector<std::int32_t> next_slot(n_pairs);
  std::vector<double> next_rest(n_pairs);
  std::vector<typename Kind::Hint> next_hint(n_pairs);
  const auto stays_whole = [&](const std::size_t i)
  {
    const auto [begin, end] = old_row(i);
    return found.row[i] == found.row[i + 1] && next.row[i + 1] - next.row[i] == end - begin;
  };
  const auto take_rows = [&](const std::size_t i, const std::size_t end_rows) // that stay whole
  {
    const std::int32_t n = next.row[end_rows] - next.row[i], from = old_row(i).first, to = next.row[i];
    const auto take = [&](const auto &old, auto &now) { std::copy_n(old.begin() + from, n, now.begin() + to); };
    take(list.first, next.first);
    take(list.second, next.second);
    take(list.image, next.image);
    take(slot, next_slot);
    take(rest_until, next_rest);
    take(hint, next_hint);
  };
  Collected<std::int32_t> left;
  parallel_ranges(n_rows, 64,
                  [&](const std::size_t part, const std::size_t begin, const std::size_t end)
                  {
                    for (std::size_t i = begin; i < end; ++i)
                    {
                      const std::size_t first_whole = i;
                      while (i < end && stays_whole(i))
                        ++i;
                      take_rows(first_whole, i);
                      if (i == end)
                        break;
                      auto [old, old_end] = old_row(i);
                      std::int32_t pair = next.row[i], now = found.row[i];
                      const std::int32_t end_found = found.row[i + 1];
                      while (old < old_end || now < end_found) // both sorted by the second partner
                      {
                        const bool was = old < old_end && !(now < end_found && found.second[now] < list.second[old]);
                        const bool is = now < end_found && !(was && list.second[old] < found.second[now]);
                        if (was && !is && !stays(old))
                        {
                          if (slot[old] != apart)
                            left.of(part).push_back(slot[old]);
                          ++old;
                          continue;
                        }
                        next.first[pair] = static_cast<std::int32_t>(i);
                        next.second[pair] = is ? found.second[now] : list.second[old];
                        next.image[pair] = is ? found.image[now] : list.image[old];
                        next_slot[pair] = was ? slot[old] : apart;
                        const bool is_guarded = was && slot[old] == apart && std::isinf(rest_until[old]);
                        constexpr double no_rest = -std::numeric_limits<double>::infinity();
                        next_rest[pair] = was && !is_guarded ? rest_until[old] : no_rest; // its guard may leave
                        next_hint[pair] = was ? hint[old] : Kind::no_hint();
                        ++pair;
                        old += was;
                        now += is;
                      }
                    }
                  });
  list = std::move(next);
  slot = std::move(next_slot);
  rest_until = std::move(next_rest);
  hint = std::move(next_hint);
  return left.all();
}

/// Whether slots lie so far from the order of their pairs, or so many are unused, that a step goes better with new
/// ones. This follows from the contacts alone, as all that the sums depend on.
template <class Kind>
bool ContactSet<Kind>::is_scattered() const
{
  constexpr std::size_t share = 8;      // of the contacts
  std::atomic<std::size_t> n_jumps = 0; // from one chunk to another, between one contact and the next
  parallel_ranges(list.size(), 4096,
                  [&](const std::size_t, const std::size_t begin, const std::size_t end)
                  {
                    std::size_t before = begin; // the pair touching before
                    while (before > 0 && slot[before - 1] == apart)
                      --before;
                    const auto chunk_of = [&](const std::size_t pair) { return slot[pair] / slots_per_chunk; };
                    std::size_t chunk = before > 0 ? chunk_of(before - 1) : 0, n = 0;
                    for (std::size_t pair = begin; pair < end; ++pair)
                      if (slot[pair] != apart)
                        n += std::exchange(chunk, chunk_of(pair)) != chunk_of(pair);
                    n_jumps += n;
                  });
  const std::size_t n_contacts = store.size();
  return n_jumps > n_contacts / share + store.n_chunks() ||
         store.n_slots() > n_contacts + n_contacts / share + slots_per_chunk;
}

/// Moves contacts to slots in the order of their pairs, nearly.
template <class Kind>
void ContactSet<Kind>::compact(const Particles &particles)
{
  Collected<std::int32_t> touching_pairs;
  parallel_ranges(list.size(), 4096,
                  [&](const std::size_t part, const std::size_t begin, const std::size_t end)
                  {
                    for (std::size_t pair = begin; pair < end; ++pair)
                      if (slot[pair] != apart)
                        touching_pairs.of(part).push_back(static_cast<std::int32_t>(pair));
                  });
  const std::vector<std::int32_t> pairs = touching_pairs.all();
  typename Kind::Store ordered;
  ordered.resize(pairs.size());
  parallel_for(pairs.size(),
               [&](const std::size_t k)
               {
                 const ContactSearch place = place_of(pairs[k], particles);
                 const std::int32_t to =
                     Kind::is_interleaved ? interleaved_slot(k, pairs.size()) : static_cast<std::int32_t>(k);
                 ordered.put(to, {place.pair, place.first, place.second, place.image}, store.get(place.slot));
                 slot[place.pair] = to;
               });
  store = std::move(ordered);
  loads = {}; // particles and walls may have other numbers by now
}

template <class Kind>
void ContactSet<Kind>::reorder(const std::vector<std::int32_t> &new_part, const std::size_t n_parts)
{
  struct Place
  {
    std::int32_t first, second, pair;
    bool is_exchanged;
  };
  std::vector<Place> places;
  places.reserve(list.size());
  for (std::size_t pair = 0; pair < list.size(); ++pair)
  {
    const std::int32_t i = new_part[list.first[pair]];
    const std::int32_t j = Kind::second_is_wall ? list.second[pair] : new_part[list.second[pair]];
    if (i == removed_part || (!Kind::second_is_wall && j == removed_part))
    {
      if (slot[pair] != apart)
        forget(slot[pair], release(store.get(slot[pair])));
      continue;
    }
    const bool is_exchanged = !Kind::second_is_wall && i > j;
    places.push_back({is_exchanged ? j : i, is_exchanged ? i : j, static_cast<std::int32_t>(pair), is_exchanged});
  }
  std::sort(places.begin(), places.end(),
            [](const Place &a, const Place &b)
            { return a.first != b.first ? a.first < b.first : a.second < b.second; });

  const VerletList old_list = std::move(list);
  const std::vector<std::int32_t> old_slot = std::move(slot);
  const std::vector<double> old_rest = std::move(rest_until);
  const std::vector<typename Kind::Hint> old_hint = std::move(hint);
  list = {};
  list.row.assign(n_parts + 1, 0);
  slot.clear();
  rest_until.clear();
  hint.clear();
  for (const Place &place : places)
  {
    const Image image = old_list.image[place.pair];
    ++list.row[place.first + 1];
    list.first.push_back(place.first);
    list.second.push_back(place.second);
    list.image.push_back(place.is_exchanged ? opposite(image) : image);
    slot.push_back(old_slot[place.pair]);
    rest_until.push_back(old_rest[place.pair]);
    hint.push_back(old_hint[place.pair]);
    if (!place.is_exchanged)
      continue;
    Kind::exchange_bodies(hint.back());
    if (slot.back() == apart)
      continue;
    State state = store.get(slot.back());
    Kind::exchange_bodies(state);
    store.set(slot.back(), state);
  }
  std::partial_sum(list.row.begin(), list.row.end(), list.row.begin());
  // The store's pairs and bodies follow at the renewal.
}

template <class Kind>
void ContactSet<Kind>::remove_walls(const std::int32_t first, const std::int32_t n) requires Kind::second_is_wall
{
  for (auto *seconds : {&list.second, &store.second})
    for (std::int32_t &second : *seconds)
      if (second >= first + n)
        second -= n;
      else if (second >= first)
        second = -1; // none has this number: the next renewal drops the contact
  const auto end = static_cast<std::ptrdiff_t>(ended_friction.size());
  ended_friction.erase(ended_friction.begin() + std::min<std::ptrdiff_t>(first, end),
                       ended_friction.begin() + std::min<std::ptrdiff_t>(first + n, end));
}

} // namespace bergamo::dem
