#include "dem/force/load_sums.h"

#include "dem/core/parallel.h"

#include <algorithm>

namespace bergamo::dem
{
namespace
{

constexpr std::int32_t none = -1;

/// Room in a chunk of n bodies, and for the chunks of a body that has n: more come with contacts that begin.
/// @param n_to_come slots that the chunk does not have yet
std::int32_t with_room_in_chunk(const std::size_t n, const std::size_t n_to_come)
{
  return static_cast<std::int32_t>(n + std::max(n / 4, 2 * n_to_come) + 32);
}
std::int32_t with_room_of_body(const std::int32_t n)
{
  return n + 2;
}

} // namespace

void LoadSums::list_bodies(const std::vector<std::int32_t> &first, const std::vector<std::int32_t> &second,
                           const std::size_t n_bodies)
{
  const std::size_t n_slots = first.size(), n = (n_slots + slots_per_chunk - 1) / slots_per_chunk;
  std::vector<std::vector<std::int32_t>> bodies_of(n);
  std::vector<std::vector<BodyLoad>> loads_of(n), transfers_of(n);
  target.resize(n_slots);
  block_virial.resize(n);
  slot_virial.resize(n);

  // Within each chunk first, counted from its own beginning.
  std::vector<std::vector<std::int32_t>> place_of_thread(omp_get_max_threads());
  parallel_ranges(n, 1,
                  [&](const std::size_t, const std::size_t begin, const std::size_t end)
                  {
                    std::vector<std::int32_t> &place = place_of_thread[omp_get_thread_num()];
                    place.resize(n_bodies, none);
                    for (std::size_t chunk = begin; chunk < end; ++chunk)
                    {
                      std::vector<std::int32_t> &bodies = bodies_of[chunk];
                      const std::size_t first_slot = chunk * slots_per_chunk;
                      const std::size_t last = std::min(first_slot + slots_per_chunk, n_slots);
                      for (std::size_t slot = first_slot; slot < last; ++slot)
                        for (const std::int32_t b : {first[slot], second[slot]})
                          if (place[b] == none)
                          {
                            place[b] = 0;
                            bodies.push_back(b);
                          }
                      std::sort(bodies.begin(), bodies.end()); // then add_load() reads memory in its order
                      for (std::size_t k = 0; k < bodies.size(); ++k)
                        place[bodies[k]] = static_cast<std::int32_t>(k);
                      for (std::size_t slot = first_slot; slot < last; ++slot)
                        target[slot] = {place[first[slot]], place[second[slot]]};
                      const auto keep = [&](const std::vector<BodyLoad> &sums, std::vector<BodyLoad> &kept)
                      {
                        kept.resize(bodies.size());
                        if (chunk < n_chunks() && !sums.empty())
                          for (auto entry = row[chunk]; entry < row[chunk] + count[chunk]; ++entry)
                            if (place[body[entry]] != none)
                              kept[place[body[entry]]] = sums[entry];
                      };
                      keep(load, loads_of[chunk]);
                      keep(transfer, transfers_of[chunk]);
                      for (const std::int32_t b : bodies)
                        place[b] = none;
                    }
                  });

  row.assign(n + 1, 0);
  count.assign(n, 0);
  for (std::size_t chunk = 0; chunk < n; ++chunk)
  {
    count[chunk] = static_cast<std::int32_t>(bodies_of[chunk].size());
    const std::size_t n_to_come = (chunk + 1) * slots_per_chunk - std::min((chunk + 1) * slots_per_chunk, n_slots);
    row[chunk + 1] = row[chunk] + with_room_in_chunk(bodies_of[chunk].size(), n_to_come);
  }
  body.resize(row[n]);
  load.assign(row[n], {});
  transfer.assign(sums_transfers ? row[n] : 0, {});
  parallel_ranges(n, 1,
                  [&](const std::size_t, const std::size_t begin, const std::size_t end)
                  {
                    for (std::size_t chunk = begin; chunk < end; ++chunk)
                    {
                      std::copy(bodies_of[chunk].begin(), bodies_of[chunk].end(), body.begin() + row[chunk]);
                      std::copy(loads_of[chunk].begin(), loads_of[chunk].end(), load.begin() + row[chunk]);
                      if (sums_transfers)
                        std::copy(transfers_of[chunk].begin(), transfers_of[chunk].end(),
                                  transfer.begin() + row[chunk]);
                      const std::size_t last = std::min((chunk + 1) * slots_per_chunk, n_slots);
                      for (std::size_t slot = chunk * slots_per_chunk; slot < last; ++slot)
                      {
                        target[slot].first += row[chunk];
                        target[slot].second += row[chunk];
                      }
                    }
                  });

  body_count.assign(n_bodies, 0);
  for (const std::vector<std::int32_t> &bodies : bodies_of)
    for (const std::int32_t b : bodies)
      ++body_count[b];
  body_row.assign(n_bodies + 1, 0);
  for (std::size_t b = 0; b < n_bodies; ++b)
    body_row[b + 1] = body_row[b] + with_room_of_body(body_count[b]);
  body_entry.resize(body_row[n_bodies]);
  body_count.assign(n_bodies, 0);
  for (std::size_t chunk = 0; chunk < n; ++chunk)
    for (auto entry = row[chunk]; entry < row[chunk] + count[chunk]; ++entry)
      body_entry[body_row[body[entry]] + body_count[body[entry]]++] = entry;
  current = true;
}

void LoadSums::take(const std::int32_t slot, const std::int32_t first, const std::int32_t second)
{
  const std::size_t chunk = slot / slots_per_chunk;
  if (chunk >= n_chunks())
    current = false;
  if (!current)
    return;
  const std::int32_t entry1 = entry_of(chunk, first), entry2 = entry_of(chunk, second);
  if (entry1 == none || entry2 == none)
  {
    current = false;
    return;
  }
  if (target.size() <= static_cast<std::size_t>(slot)) // slots come in blocks, of which the others are unused
    target.resize((slot / pack_width + 1) * pack_width, {entry1, entry1});
  target[slot] = {entry1, entry2};
}

/// Entry of a body in a chunk, made if there is none yet; `none` if there is no room.
std::int32_t LoadSums::entry_of(const std::size_t chunk, const std::int32_t body_index)
{
  const std::int32_t end = row[chunk] + count[chunk];
  const auto known = std::find(body.begin() + row[chunk], body.begin() + end, body_index);
  if (known != body.begin() + end)
    return static_cast<std::int32_t>(known - body.begin());
  if (end == row[chunk + 1] || !list_entry(body_index, end))
    return none;
  body[end] = body_index;
  load[end] = {};
  if (sums_transfers)
    transfer[end] = {};
  ++count[chunk];
  return end;
}

/// Adds an entry to those of its body. @return whether there was room
bool LoadSums::list_entry(const std::int32_t body_index, const std::int32_t entry)
{
  const auto begin = body_entry.begin() + body_row[body_index], end = begin + body_count[body_index];
  if (end == body_entry.begin() + body_row[body_index + 1])
    return false;
  const auto place = std::lower_bound(begin, end, entry);
  std::move_backward(place, end, end + 1);
  *place = entry;
  ++body_count[body_index];
  return true;
}

void LoadSums::sum_transfers(const bool are_wanted)
{
  sums_transfers = are_wanted;
  transfer.assign(are_wanted ? load.size() : 0, {});
}

void LoadSums::add_virial(Virial<double> &sum) const
{
  for (std::size_t chunk = 0; chunk < n_chunks(); ++chunk)
  {
    for (int lane = 0; lane < pack_width; ++lane)
    {
      sum.branch += math::lane<Pack>(block_virial[chunk].branch, lane);
      sum.image += math::lane<Pack>(block_virial[chunk].image, lane);
    }
    sum.branch += slot_virial[chunk].branch;
    sum.image += slot_virial[chunk].image;
  }
}

} // namespace bergamo::dem
