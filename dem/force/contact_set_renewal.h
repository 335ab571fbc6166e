#pragma once

#include "dem/force/contact_set.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

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
void ContactSet<Kind>::renew(VerletList new_list, const Particles &particles)
{
  constexpr double no_rest = -std::numeric_limits<double>::infinity();
  std::vector<std::int32_t> new_slot(new_list.size(), apart);
  std::vector<double> new_rest(new_list.size(), no_rest);
  std::vector<typename Kind::Hint> new_hint(new_list.size(), Kind::no_hint());
  Collected<std::int32_t> left;
  parallel_ranges(new_list.row.empty() ? 0 : new_list.row.size() - 1, 64,
                  [&](const std::size_t part, const std::size_t begin, const std::size_t end)
                  {
                    for (std::size_t i = begin; i < end; ++i)
                    {
                      // Both rows are sorted by the second partner: walk them together. Parts that came have none.
                      const bool had_row = i + 1 < list.row.size();
                      std::size_t old_pair = had_row ? list.row[i] : 0;
                      const std::size_t old_end = had_row ? list.row[i + 1] : 0;
                      const auto leave = [&]
                      {
                        if (slot[old_pair] != apart)
                          left.of(part).push_back(static_cast<std::int32_t>(old_pair));
                        ++old_pair;
                      };
                      for (auto pair = new_list.row[i]; pair < new_list.row[i + 1]; ++pair)
                      {
                        while (old_pair < old_end && list.second[old_pair] < new_list.second[pair])
                          leave();
                        if (old_pair < old_end && list.second[old_pair] == new_list.second[pair])
                        {
                          new_slot[pair] = slot[old_pair];
                          const bool is_guarded = slot[old_pair] == apart && std::isinf(rest_until[old_pair]);
                          new_rest[pair] = is_guarded ? no_rest : rest_until[old_pair]; // its guard may leave
                          new_hint[pair] = hint[old_pair];
                          ++old_pair;
                        }
                      }
                      while (old_pair < old_end)
                        leave();
                    }
                  });
  left.for_each(
      [&](const std::int32_t pair)
      {
        losses += release(store.get(slot[pair]));
        store.remove(slot[pair]);
      });
  list = std::move(new_list);
  slot = std::move(new_slot);
  rest_until = std::move(new_rest);
  hint = std::move(new_hint);
  Collected<std::int32_t> touching_pairs;
  parallel_ranges(list.size(), 4096,
                  [&](const std::size_t part, const std::size_t begin, const std::size_t end)
                  {
                    for (std::size_t pair = begin; pair < end; ++pair)
                      if (slot[pair] != apart)
                        touching_pairs.of(part).push_back(static_cast<std::int32_t>(pair));
                  });
  compact(touching_pairs.all(), particles);
}

/// Moves contacts to slots in the order of their pairs, nearly. @param pairs those that touch, in their order
template <class Kind>
void ContactSet<Kind>::compact(const std::vector<std::int32_t> &pairs, const Particles &particles)
{
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
      {
        losses += release(store.get(slot[pair]));
        store.remove(slot[pair]);
      }
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
  for (std::int32_t &second : list.second)
    if (second >= first + n)
      second -= n;
    else if (second >= first)
      second = -1; // none has this number: the next renewal drops the contact
}

} // namespace bergamo::dem
