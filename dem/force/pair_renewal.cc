#include "dem/force/pair_contacts.h"

#include "dem/core/parallel.h"
#include "dem/neighbour/spatial_order.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace bergamo::dem
{
namespace
{

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The same contact seen with its bodies exchanged.
void exchange_bodies(ContactState<double> &s)
{
  s.normal = -s.normal;
  s.forces.tangential = -s.forces.tangential;
  s.spin = -s.spin; // about the normal
}

void exchange_bodies(SphereContactState<double> &s)
{
  s.forces.tangential = -s.forces.tangential;
}

/// Slot of the k-th of n contacts. Contacts next to each other share a grain; so that the lanes of a block do not wait
/// for one another when they add to its load, such go to the same lane of consecutive blocks.
std::int32_t slot_of(const std::size_t k, const std::size_t n)
{
  constexpr std::size_t square = pack_width * pack_width;
  const std::size_t begin = k / square * square, place = k - begin;
  if (begin + square > n)
    return static_cast<std::int32_t>(k);
  return static_cast<std::int32_t>(begin + place % pack_width * pack_width + place / pack_width);
}

/// Moves contacts to slots in the order of their pairs, nearly. @param pairs those that touch, in their order
template <template <class> class State>
void compact(ContactStore<State> &store, const std::vector<std::int32_t> &pairs,
             const std::vector<Image> &image_of_pair, std::vector<std::int32_t> &slot_of_pair)
{
  ContactStore<State> ordered;
  ordered.resize(pairs.size());
  parallel_for(pairs.size(),
               [&](const std::size_t k)
               {
                 const std::int32_t pair = pairs[k], from = slot_of_pair[pair], to = slot_of(k, pairs.size());
                 ordered.put(to, {pair, store.first[from], store.second[from], image_of_pair[pair]}, store.get(from));
                 slot_of_pair[pair] = to;
               });
  store = std::move(ordered);
}

} // namespace

void PairContacts::renew(VerletList new_list, const Particles &particles)
{
  std::vector<std::int32_t> new_slot(new_list.size(), apart);
  std::vector<double> new_rest(new_list.size(), -infinity);
  std::vector<Eigen::Vector3f> new_direction(new_list.size(), Eigen::Vector3f::Zero());
  Collected<std::int32_t> left;
  const bool had_list = !list.row.empty();
  parallel_ranges(particles.size(), 64,
                  [&](const std::size_t part, const std::size_t begin, const std::size_t end)
                  {
                    for (std::size_t i = begin; i < end; ++i)
                    {
                      // Both rows are sorted by the second partner: walk them together.
                      std::size_t old_pair = had_list ? list.row[i] : 0;
                      const std::size_t old_end = had_list ? list.row[i + 1] : 0;
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
                          new_rest[pair] = rest_until[old_pair];
                          new_direction[pair] = separating_direction[old_pair];
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
        if (are_spheres(list.first[pair], list.second[pair]))
        {
          losses += release(spheres.get(slot[pair]));
          spheres.remove(slot[pair]);
        }
        else
        {
          losses += release(grains.get(slot[pair]));
          grains.remove(slot[pair]);
        }
      });
  is_sphere.resize(particles.size());
  parallel_for(particles.size(), [&](const std::size_t i) { is_sphere[i] = particles.shape[i].is_sphere(); });
  list = std::move(new_list);
  slot = std::move(new_slot);
  rest_until = std::move(new_rest);
  separating_direction = std::move(new_direction);
  Collected<std::int32_t> grain_pairs, sphere_pairs;
  parallel_ranges(
      list.size(), 4096,
      [&](const std::size_t part, const std::size_t begin, const std::size_t end)
      {
        for (std::size_t pair = begin; pair < end; ++pair)
          if (slot[pair] != apart)
          {
            const bool is_of_spheres = are_spheres(list.first[pair], list.second[pair]);
            (is_of_spheres ? sphere_pairs : grain_pairs).of(part).push_back(static_cast<std::int32_t>(pair));
          }
      });
  compact(grains, grain_pairs.all(), list.image, slot);
  compact(spheres, sphere_pairs.all(), list.image, slot);
  grain_loads.slots_were_moved();
  sphere_loads.slots_were_moved();
}

void PairContacts::reorder(const std::vector<std::int32_t> &order, const Particles &reordered)
{
  const std::vector<std::int32_t> new_index = inverse_order(order);
  for (std::size_t i = 0; i < is_sphere.size(); ++i)
    is_sphere[i] = reordered.shape[i].is_sphere();
  struct Place
  {
    std::int32_t first, second, pair;
    bool is_exchanged;
  };
  std::vector<Place> places(list.size());
  for (std::size_t pair = 0; pair < list.size(); ++pair)
  {
    const std::int32_t i = new_index[list.first[pair]], j = new_index[list.second[pair]];
    places[pair] = {std::min(i, j), std::max(i, j), static_cast<std::int32_t>(pair), i > j};
  }
  std::sort(places.begin(), places.end(),
            [](const Place &a, const Place &b)
            { return a.first != b.first ? a.first < b.first : a.second < b.second; });

  VerletList sorted;
  sorted.row.assign(reordered.size() + 1, 0);
  std::vector<std::int32_t> sorted_slot;
  std::vector<double> sorted_rest;
  std::vector<Eigen::Vector3f> sorted_direction;
  const auto exchange = [](auto &store, const std::int32_t slot)
  {
    auto state = store.get(slot);
    exchange_bodies(state);
    store.set(slot, state);
  };
  for (const Place &place : places)
  {
    ++sorted.row[place.first + 1];
    sorted.first.push_back(place.first);
    sorted.second.push_back(place.second);
    const Image image = list.image[place.pair];
    sorted.image.push_back(place.is_exchanged ? opposite(image) : image);
    sorted_slot.push_back(slot[place.pair]);
    sorted_rest.push_back(rest_until[place.pair]);
    const float sign = place.is_exchanged ? -1.f : 1.f;
    sorted_direction.push_back(sign * separating_direction[place.pair]);
    if (slot[place.pair] == apart)
      continue;
    const std::int32_t s = slot[place.pair];
    const bool is_sphere = are_spheres(place.first, place.second);
    if (place.is_exchanged && is_sphere)
      exchange(spheres, s);
    else if (place.is_exchanged)
      exchange(grains, s);
    (is_sphere ? spheres.first : grains.first)[s] = place.first;
    (is_sphere ? spheres.second : grains.second)[s] = place.second;
  }
  std::partial_sum(sorted.row.begin(), sorted.row.end(), sorted.row.begin());
  list = std::move(sorted);
  slot = std::move(sorted_slot);
  rest_until = std::move(sorted_rest);
  separating_direction = std::move(sorted_direction);
}

} // namespace bergamo::dem
