#pragma once

#include "dem/core/pack.h"
#include "dem/state/periodic_cell.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

namespace bergamo::dem
{

/// One contact of a pack. State<Real> holds nothing but numbers of type Real.
template <template <class> class State>
State<double> lane_of(const State<Pack> &pack, const int lane)
{
  constexpr std::size_t n_fields = sizeof(State<double>) / sizeof(double);
  static_assert(sizeof(State<Pack>) == sizeof(State<double>) * pack_width);
  State<double> state = State<double>::idle();
  const auto *source = reinterpret_cast<const double *>(&pack) + lane;
  auto *target = reinterpret_cast<double *>(&state);
  for (std::size_t f = 0; f < n_fields; ++f)
    target[f] = source[f * pack_width];
  return state;
}

/// Slots that belong together: their contacts are followed by one thread and summed by themselves.
constexpr std::size_t slots_per_chunk = 512;

/// Whose contact a slot holds.
struct SlotOwner
{
  std::int32_t pair;          ///< of the candidates
  std::int32_t first, second; ///< particles; the second may be a wall
  Image image = own_image;    ///< of the second
};

/// Touching contacts in blocks of one pack each: lane k of block b is slot b * pack_width + k. A slot keeps its contact
/// until that ends; then it is free for another. Forces are summed in the order of the slots, so that their last bits
/// depend on it: who gets which slot follows from the contacts alone, not from threads or from a restart.
template <template <class> class State>
class ContactStore
{
public:
  static constexpr std::int32_t free_slot = -1;

  std::size_t n_blocks() const { return blocks.size(); }
  std::size_t n_slots() const { return pair.size(); }
  std::size_t n_chunks() const { return n_free.size(); }
  std::int32_t size() const
  {
    return static_cast<std::int32_t>(n_slots()) - std::accumulate(n_free.begin(), n_free.end(), 0);
  }

  /// Puts a contact into the first free slot of the chunk of another one, else of the last chunk, else into a new one.
  /// @param near slot of a contact close by, or none
  std::int32_t add(const SlotOwner &owner, const State<double> &state, const std::int32_t near = free_slot)
  {
    std::size_t chunk = near < 0 ? n_chunks() - 1 : near / slots_per_chunk;
    if (n_slots() == 0 || n_free[chunk] == 0)
    {
      if (n_slots() == 0 || n_free.back() == 0)
        grow();
      chunk = n_chunks() - 1;
    }
    --n_free[chunk];
    const auto slot =
        static_cast<std::int32_t>(std::find(pair.begin() + first_free[chunk], pair.end(), free_slot) - pair.begin());
    first_free[chunk] = slot + 1;
    put(slot, owner, state);
    return slot;
  }

  void put(const std::int32_t slot, const SlotOwner &owner, const State<double> &state)
  {
    pair[slot] = owner.pair;
    first[slot] = owner.first;
    second[slot] = owner.second;
    image[slot] = owner.image;
    set(slot, state);
  }

  void remove(const std::int32_t slot)
  {
    pair[slot] = free_slot;
    first[slot] = second[slot] = 0;
    image[slot] = own_image;
    set(slot, State<double>::idle());
    const std::size_t chunk = slot / slots_per_chunk;
    ++n_free[chunk];
    first_free[chunk] = std::min(first_free[chunk], slot);
  }

  /// Makes room for n contacts in the slots 0 .. n - 1 of an empty store, to be filled by put().
  void resize(const std::size_t n)
  {
    const std::size_t n_all = (n + pack_width - 1) / pack_width * pack_width;
    blocks.reserve(n_all / pack_width * 17 / 16); // for contacts that begin
    blocks.assign(n_all / pack_width, State<Pack>::idle());
    pair.assign(n_all, free_slot);
    first.assign(n_all, 0);
    second.assign(n_all, 0);
    image.assign(n_all, own_image);
    make_chunks();
    if (n_all > n)
      n_free.back() = static_cast<std::int32_t>(n_all - n);
  }

  State<double> get(const std::int32_t slot) const { return lane_of(blocks[slot / pack_width], slot % pack_width); }

  double weight_of(const std::int32_t slot) const
  {
    return math::lane(blocks[slot / pack_width].weight, slot % pack_width);
  }

  void set(const std::int32_t slot, const State<double> &state)
  {
    const auto *numbers = reinterpret_cast<const double *>(&state);
    auto *target = reinterpret_cast<double *>(&blocks[slot / pack_width]) + slot % pack_width;
    for (std::size_t f = 0; f < n_fields; ++f)
      target[f * pack_width] = numbers[f];
  }

  /// Copies the contact of a slot into a lane of a pack, or back.
  void copy_lane(const std::int32_t slot, State<Pack> &pack, const int lane) const
  {
    copy_numbers(blocks[slot / pack_width], slot % pack_width, pack, lane);
  }
  void take_lane(const std::int32_t slot, const State<Pack> &pack, const int lane)
  {
    copy_numbers(pack, lane, blocks[slot / pack_width], slot % pack_width);
  }

  /// Fetches a block ahead.
  [[gnu::always_inline]] void prefetch(const std::size_t block) const
  {
    const auto *line = reinterpret_cast<const char *>(&blocks[block]);
    for (std::size_t byte = 0; byte < sizeof(State<Pack>); byte += 64)
      __builtin_prefetch(line + byte);
  }

  /// All slots one after another, used or not, as a snapshot keeps them.
  std::vector<State<double>> states() const
  {
    std::vector<State<double>> all;
    for (std::size_t slot = 0; slot < n_slots(); ++slot)
      all.push_back(get(static_cast<std::int32_t>(slot)));
    return all;
  }

  /// Fills the blocks from a snapshot, after pair, first, second and image have been set; it may come from packs of
  /// another width.
  void restore(const std::vector<State<double>> &states)
  {
    const std::size_t n_all = (states.size() + pack_width - 1) / pack_width * pack_width;
    pair.resize(n_all, free_slot);
    first.resize(n_all, 0);
    second.resize(n_all, 0);
    image.resize(n_all, own_image);
    blocks.assign(n_all / pack_width, State<Pack>::idle());
    make_chunks();
    for (std::size_t slot = 0; slot < n_all; ++slot)
    {
      if (slot < states.size())
        set(static_cast<std::int32_t>(slot), states[slot]);
      n_free[slot / slots_per_chunk] += pair[slot] == free_slot;
    }
  }

  /// All that a step depends on; see dem/core/state.h. Places of a snapshot may come from packs of another width.
  template <class Self, class Visit>
  static void visit_state(Self &self, Visit &visit)
  {
    std::vector<State<double>> numbers = self.states();
    visit("pair", self.pair);
    visit("first", self.first);
    visit("second", self.second);
    visit("image", self.image);
    visit("state", numbers);
    if constexpr (Visit::is_reading)
      self.restore(numbers);
  }

  std::vector<State<Pack>> blocks;
  std::vector<std::int32_t> pair;          ///< of the candidates, by slot; free_slot where unused
  std::vector<std::int32_t> first, second; ///< particles by slot; the second may be a wall
  std::vector<Image> image;                ///< of the second, by slot

private:
  std::vector<std::int32_t> n_free;     // unused slots by chunk
  std::vector<std::int32_t> first_free; // by chunk: no slot before this one is unused

  static constexpr std::size_t n_fields = sizeof(State<double>) / sizeof(double);

  static void copy_numbers(const State<Pack> &from, const int from_lane, State<Pack> &to, const int to_lane)
  {
    const auto *source = reinterpret_cast<const double *>(&from) + from_lane;
    auto *target = reinterpret_cast<double *>(&to) + to_lane;
    for (std::size_t f = 0; f < n_fields; ++f)
      target[f * pack_width] = source[f * pack_width];
  }

  void make_chunks()
  {
    const std::size_t n = (n_slots() + slots_per_chunk - 1) / slots_per_chunk;
    n_free.assign(n, 0);
    first_free.resize(n);
    for (std::size_t chunk = 0; chunk < n; ++chunk)
      first_free[chunk] = static_cast<std::int32_t>(chunk * slots_per_chunk);
  }

  void grow()
  {
    const auto n = static_cast<std::int32_t>(n_slots());
    blocks.push_back(State<Pack>::idle());
    pair.resize(n + pack_width, free_slot);
    first.resize(n + pack_width, 0);
    second.resize(n + pack_width, 0);
    image.resize(n + pack_width, own_image);
    if (n % slots_per_chunk == 0)
    {
      n_free.push_back(0);
      first_free.push_back(n);
    }
    n_free.back() += pack_width;
  }
};

/// Has every contact of a store searched anew at the next step: its motion budget is used up.
template <template <class> class State>
void search_all_anew(ContactStore<State> &store)
{
  for (State<Pack> &block : store.blocks)
    block.budget = math::select(block.weight != 0., Pack(-1.), block.budget);
}

} // namespace bergamo::dem
