#pragma once

#include "dem/core/parallel.h"

#include <cstddef>
#include <utility>
#include <vector>

namespace bergamo
{

/// Replaces each whole number by the sum of those before it, the last one by the sum of all if it was zero.
template <class Number>
void exclusive_sum(std::vector<Number> &counts)
{
  constexpr std::size_t chunk = 4096;
  const auto each_of = [&](const std::size_t k, const auto &body)
  {
    for (std::size_t i = k * chunk; i < std::min((k + 1) * chunk, counts.size()); ++i)
      body(counts[i]);
  };
  std::vector<Number> before((counts.size() + chunk - 1) / chunk, 0); // of each chunk
  const auto for_chunks = [&](const auto &body)
  {
    parallel_ranges(before.size(), 1,
                    [&](const std::size_t, const std::size_t begin, const std::size_t end)
                    {
                      for (std::size_t k = begin; k < end; ++k)
                        body(k);
                    });
  };
  for_chunks([&](const std::size_t k) { each_of(k, [&](const Number count) { before[k] += count; }); });
  Number sum = 0;
  for (Number &of_chunk : before)
    of_chunk = std::exchange(sum, sum + of_chunk);
  for_chunks(
      [&](const std::size_t k)
      {
        Number next = before[k];
        each_of(k, [&](Number &count) { count = std::exchange(next, next + count); });
      });
}

} // namespace bergamo
