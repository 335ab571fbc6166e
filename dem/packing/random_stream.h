#pragma once

#include <cstdint>

namespace bergamo::dem
{

/// Random numbers that depend on a seed and two counters alone, so that every grain has its own ones in every iteration
/// on whatever thread: SplitMix64 (Steele, Lea & Flood 2014) from a start that mixes the three.
class RandomStream
{
public:
  RandomStream(const std::uint64_t seed, const std::uint64_t iteration, const std::uint64_t item)
      : state(mix(mix(mix(seed + step) + iteration + step) + item + step))
  {
  }

  /// In [0, 1), 53 bits.
  double uniform() { return static_cast<double>(next() >> 11) * 0x1p-53; }

  double uniform(const double low, const double high) { return low + (high - low) * uniform(); }

  /// A seed of its own for every value.
  static std::uint64_t mixed(const std::uint64_t value) { return mix(value + step); }

private:
  static constexpr std::uint64_t step = 0x9e3779b97f4a7c15;

  static std::uint64_t mix(std::uint64_t z)
  {
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
    return z ^ (z >> 31);
  }

  std::uint64_t next() { return mix(state += step); }

  std::uint64_t state;
};

} // namespace bergamo::dem
