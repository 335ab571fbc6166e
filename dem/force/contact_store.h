#pragma once

#include "dem/core/pack.h"

#include <cstdint>
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

/// Touching contacts in blocks of one pack each: lane k of block b is slot b * pack_width + k. A slot keeps its contact
/// until that ends; then it is free for another. Only the order of memory depends on the slots, never a result.
template <template <class> class State>
class ContactStore
{
public:
  using Result = typename State<double>::Result; ///< what a contact gives to its bodies
  static constexpr std::int32_t free_slot = -1;

  std::size_t n_blocks() const { return blocks.size(); }
  std::size_t n_slots() const { return pair.size(); }
  std::int32_t size() const { return static_cast<std::int32_t>(pair.size() - free.size()); }

  /// @param pair_index of the Verlet list; @param i, j its grains
  std::int32_t add(const std::int32_t pair_index, const std::int32_t i, const std::int32_t j,
                   const State<double> &state, const Result &r)
  {
    if (free.empty())
      grow();
    const std::int32_t slot = free.back();
    free.pop_back();
    pair[slot] = pair_index;
    first[slot] = i;
    second[slot] = j;
    set(slot, state);
    resultant[slot] = r;
    return slot;
  }

  void remove(const std::int32_t slot)
  {
    pair[slot] = free_slot;
    first[slot] = second[slot] = 0;
    set(slot, State<double>::idle());
    free.push_back(slot);
  }

  /// Makes room for n contacts in the slots 0 .. n - 1 of an empty store, to be filled by the caller.
  void resize(const std::size_t n)
  {
    const std::size_t n_all = (n + pack_width - 1) / pack_width * pack_width;
    blocks.assign(n_all / pack_width, State<Pack>::idle());
    pair.assign(n_all, free_slot);
    first.assign(n_all, 0);
    second.assign(n_all, 0);
    resultant.assign(n_all, {});
    free.clear();
    for (std::size_t slot = n_all; slot > n; --slot)
      free.push_back(static_cast<std::int32_t>(slot - 1));
  }

  State<double> get(const std::int32_t slot) const { return lane_of(blocks[slot / pack_width], slot % pack_width); }

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

  /// All slots one after another, used or not, as a snapshot keeps them.
  std::vector<State<double>> states() const
  {
    std::vector<State<double>> all;
    for (std::size_t slot = 0; slot < n_slots(); ++slot)
      all.push_back(get(static_cast<std::int32_t>(slot)));
    return all;
  }

  /// Fills the blocks from a snapshot, after all other members have been set; it may come from packs of another width.
  void restore(const std::vector<State<double>> &states)
  {
    blocks.clear();
    while (pair.size() % pack_width != 0)
    {
      free.insert(free.begin(), static_cast<std::int32_t>(pair.size()));
      pair.push_back(free_slot);
      first.push_back(0);
      second.push_back(0);
      resultant.emplace_back();
    }
    blocks.resize(pair.size() / pack_width, State<Pack>::idle());
    for (std::size_t slot = 0; slot < states.size(); ++slot)
      set(static_cast<std::int32_t>(slot), states[slot]);
  }

  std::vector<State<Pack>> blocks;
  std::vector<std::int32_t> pair;          ///< of the Verlet list, by slot; free_slot where unused
  std::vector<std::int32_t> first, second; ///< grains by slot
  std::vector<std::int32_t> free;          ///< unused slots, the next to be taken at the end
  std::vector<Result> resultant;           ///< by slot, of this step

private:
  static constexpr std::size_t n_fields = sizeof(State<double>) / sizeof(double);

  static void copy_numbers(const State<Pack> &from, const int from_lane, State<Pack> &to, const int to_lane)
  {
    const auto *source = reinterpret_cast<const double *>(&from) + from_lane;
    auto *target = reinterpret_cast<double *>(&to) + to_lane;
    for (std::size_t f = 0; f < n_fields; ++f)
      target[f * pack_width] = source[f * pack_width];
  }

  void grow()
  {
    const auto n = static_cast<std::int32_t>(n_slots());
    blocks.push_back(State<Pack>::idle());
    pair.resize(n + pack_width, free_slot);
    first.resize(n + pack_width, 0);
    second.resize(n + pack_width, 0);
    resultant.resize(n + pack_width);
    for (int k = pack_width - 1; k >= 0; --k)
      free.push_back(n + k);
  }
};

} // namespace bergamo::dem
