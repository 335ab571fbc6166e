#pragma once

#include "dem/force/contact_set.h"
#include "dem/state/repeated.h"

#include <algorithm>
#include <utility>

/// How a ContactSet follows a periodic cell to its copies; for the sources of the kinds alone.
namespace bergamo::dem
{

template <class Kind>
void ContactSet<Kind>::repeat(const CellCopies &copies, const std::size_t n_parts)
{
  const VerletList of_cell = std::move(list);
  const std::vector<std::int32_t> slot_of_cell = std::move(slot);
  const std::vector<double> rest_of_cell = std::move(rest_until);
  const std::vector<typename Kind::Hint> hint_of_cell = std::move(hint);
  const typename Kind::Store store_of_cell = std::move(store);
  const auto n_touching = static_cast<std::size_t>(store_of_cell.size());
  list = {};
  slot.clear();
  rest_until.clear();
  hint.clear();
  store = {};
  if (n_touching > 0)
    store.resize(copies.n() * n_touching);
  std::int32_t next_slot = 0;

  struct Place
  {
    std::int32_t second, pair;
    Image image;
    bool is_exchanged;
  };
  std::vector<std::vector<Place>> rows(copies.n() * n_parts);
  for (int copy = 0; copy < copies.n(); ++copy)
    for (std::size_t pair = 0; pair < of_cell.size(); ++pair)
    {
      const auto n = static_cast<std::int32_t>(n_parts);
      const std::int32_t i = copy * n + of_cell.first[pair];
      const auto number = static_cast<std::int32_t>(pair);
      if constexpr (Kind::second_is_wall)
        rows[i].push_back({of_cell.second[pair], number, own_image, false});
      else
      {
        const auto [other, image] = copies.seen_from(copy, of_cell.image[pair]);
        const std::int32_t j = other * n + of_cell.second[pair];
        rows[std::min(i, j)].push_back({std::max(i, j), number, i < j ? image : opposite(image), i > j});
      }
    }
  list.row.assign(1, 0);
  for (std::size_t i = 0; i < rows.size(); ++i)
  {
    std::sort(rows[i].begin(), rows[i].end(), [](const Place &a, const Place &b) { return a.second < b.second; });
    for (const Place &place : rows[i])
    {
      const auto pair = static_cast<std::int32_t>(list.first.size());
      list.first.push_back(static_cast<std::int32_t>(i));
      list.second.push_back(place.second);
      list.image.push_back(place.image);
      rest_until.push_back(rest_of_cell[place.pair]);
      hint.push_back(hint_of_cell[place.pair]);
      slot.push_back(slot_of_cell[place.pair]);
      if (place.is_exchanged)
        Kind::exchange_bodies(hint.back());
      if (slot.back() == apart)
        continue;
      State state = store_of_cell.get(slot.back());
      if (place.is_exchanged)
        Kind::exchange_bodies(state);
      slot.back() = next_slot++;
      store.put(slot.back(), {pair, 0, 0, place.image}, state); // bodies follow at the renewal
    }
    list.row.push_back(static_cast<std::int32_t>(list.first.size()));
  }
  loads = {};
}

} // namespace bergamo::dem
