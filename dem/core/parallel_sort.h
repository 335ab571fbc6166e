#pragma once

#include "dem/core/parallel.h"

#include <algorithm>
#include <vector>

namespace bergamo
{

/// Sorts by runs, one a thread, which are merged two by two.
/// @param comes_first strict and total, so that one order alone is right: then threads change nothing
template <class T, class ComesFirst>
void parallel_sort(std::vector<T> &values, const ComesFirst &comes_first)
{
  constexpr std::size_t least_of_a_run = 2048;
  std::size_t n_runs = 1;
  while (2 * n_runs <= static_cast<std::size_t>(omp_get_max_threads()) && 2 * n_runs * least_of_a_run <= values.size())
    n_runs *= 2;
  const auto run = [&](const std::size_t k) { return values.begin() + values.size() * k / n_runs; };
  parallel_ranges(n_runs, 1,
                  [&](const std::size_t, const std::size_t begin, const std::size_t end)
                  {
                    for (std::size_t k = begin; k < end; ++k)
                      std::sort(run(k), run(k + 1), comes_first);
                  });
  for (std::size_t n = 1; n < n_runs; n *= 2)
    parallel_ranges(n_runs / (2 * n), 1,
                    [&](const std::size_t, const std::size_t begin, const std::size_t end)
                    {
                      for (std::size_t k = 2 * n * begin; k < 2 * n * end; k += 2 * n)
                        std::inplace_merge(run(k), run(k + n), run(k + 2 * n), comes_first);
                    });
}

} // namespace bergamo
