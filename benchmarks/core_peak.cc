#include "benchmarks/core_peak.h"

#include "fe_dealii/element/points.h"

#include <algorithm>
#include <chrono>
#include <vector>

namespace bergamo::benchmark
{
namespace
{

using fe::Points;

// Enough chains to hide the latency of a multiply-add on two pipes, few enough to stay in the registers.
#ifdef __AVX512F__
constexpr int n_chains = 12;
#else
constexpr int n_chains = 5;
#endif

constexpr int n_tries = 10;

double seconds_since(const std::chrono::steady_clock::time_point start)
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Keeps the compiler from dropping work whose result nobody reads.
void keep(const Points &x)
{
  asm volatile("" : : "m"(x));
}

double operations_per_second()
{
  constexpr int n_rounds = 1000000;
  Points chain[n_chains];
  for (int k = 0; k < n_chains; ++k)
    chain[k] = Points(1. + k);
  Points factor(0.999), summand(1e-3);
  asm volatile("" : "+m"(factor), "+m"(summand)); // no constants
  const auto start = std::chrono::steady_clock::now();
  for (int round = 0; round < n_rounds; ++round)
#pragma GCC unroll 12
    for (Points &x : chain)
      x = x * factor + summand;
  const double seconds = seconds_since(start);
  for (const Points &x : chain)
    keep(x);
  return 2. * fe::points_per_pack * n_chains * n_rounds / seconds;
}

double bytes_per_second(const std::vector<Points> &memory)
{
  constexpr int n_sums = 8;
  Points sum[n_sums]{};
  const auto start = std::chrono::steady_clock::now();
  for (std::size_t k = 0; k + n_sums <= memory.size(); k += n_sums)
#pragma GCC unroll 8
    for (int i = 0; i < n_sums; ++i)
      sum[i] += memory[k + i];
  const double seconds = seconds_since(start);
  for (const Points &x : sum)
    keep(x);
  return memory.size() * sizeof(Points) / seconds;
}

} // namespace

void raise_core_peak(CorePeak &peak)
{
  const std::vector<Points> memory(std::size_t(1) << 22, Points(1.)); // 256 MiB
  for (int n = 0; n < n_tries; ++n)
  {
    peak.operations = std::max(peak.operations, operations_per_second());
    peak.reading = std::max(peak.reading, bytes_per_second(memory));
  }
}

} // namespace bergamo::benchmark
