#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <omp.h>
#include <vector>
#if defined(__SANITIZE_THREAD__)
#include <sanitizer/tsan_interface.h>
#endif

namespace bergamo
{

/// Tells ThreadSanitizer of the barriers at both ends of a parallel region, which it does not see in GCC's OpenMP
/// library: what was written before leave() is known after a later enter(). No code in other builds.
struct Barrier
{
#if defined(__SANITIZE_THREAD__)
  void leave()
  {
    __tsan_release(this);
  }
  void enter()
  {
    __tsan_acquire(this);
  }
#else
  void leave() {}
  void enter() {}
#endif
};
inline Barrier team_begins, team_ends;

/// Parts that parallel_ranges makes at most: some for each thread.
inline std::size_t most_parts()
{
  return 8 * static_cast<std::size_t>(omp_get_max_threads());
}

/// One copy of the machine code of a body, whoever calls it: the compiler may contract the same sums in two copies to
/// different fused operations, and so to different last bits.
template <class Body>
[[gnu::noinline, gnu::noclone]] void run_part(Body &body, const std::size_t part, const std::size_t begin,
                                              const std::size_t end)
{
  body(part, begin, end);
}

/// Calls body(part, begin, end) for contiguous parts that make up [0, n); part 0 comes first in [0, n), and so on.
/// Every thread has the same share of [0, n) at each call, so that its data stay in the caches of its core, and works
/// it off in parts; what another has not begun when it is done it takes over. Runs alone, as one part, where there is
/// too little work for a team; else with the whole team, whatever the work: GCC's OpenMP library ends the threads that
/// a smaller team leaves out, and starts others for the next larger one. ThreadSanitizer looks into the bodies, but not
/// at how the compiler hands them to the threads: that lies within the region's own barrier.
/// @param least of [0, n) that is worth a part
template <class Body>
[[gnu::no_sanitize("thread")]] void parallel_ranges(const std::size_t n, const std::size_t least, Body &&body)
{
  const std::size_t n_parts = std::min(most_parts(), n / least);
  const std::size_t n_threads = omp_get_max_threads();
  if (n_threads < 2 || n_parts < 2)
  {
    if (n > 0)
      run_part(body, 0, 0, n);
    return;
  }
  struct alignas(64) Share // of one thread, in a line of the cache of its own
  {
    std::atomic<std::size_t> next, end; // parts
  };
  std::vector<Share> shares(n_threads);
  for (std::size_t t = 0; t < n_threads; ++t)
  {
    shares[t].next = n_parts * t / n_threads;
    shares[t].end = n_parts * (t + 1) / n_threads;
  }
  team_begins.leave();
#pragma omp parallel num_threads(n_threads)
  {
    team_begins.enter();
    const std::size_t thread = omp_get_thread_num();
    for (std::size_t k = 0; k < n_threads; ++k)
    {
      Share &share = shares[(thread + k) % n_threads];
      while (share.next < share.end)
      {
        const std::size_t part = share.next++;
        if (part < share.end)
          run_part(body, part, n * part / n_parts, n * (part + 1) / n_parts);
      }
    }
    team_ends.leave();
  }
  team_ends.enter();
}

/// Calls body(i) for i in [0, n). Each call may write only what belongs to i: then there is no race and
/// the result does not depend on the number of threads.
template <class Body>
void parallel_for(const std::size_t n, Body &&body)
{
  parallel_ranges(n, 64,
                  [&](const std::size_t, const std::size_t begin, const std::size_t end)
                  {
                    for (std::size_t i = begin; i < end; ++i)
                      body(i);
                  });
}

/// Sum of term(i) over [0, n), added up in the same order on any number of threads. @param zero to begin with
template <class T, class Term>
T ordered_sum(const std::size_t n, const T &zero, Term &&term)
{
  constexpr std::size_t chunk = 256;
  std::vector<T> sums((n + chunk - 1) / chunk, zero);
  parallel_ranges(sums.size(), 4,
                  [&](const std::size_t, const std::size_t begin, const std::size_t end)
                  {
                    for (std::size_t k = begin; k < end; ++k)
                      for (std::size_t i = k * chunk; i < std::min((k + 1) * chunk, n); ++i)
                        sums[k] += term(i);
                  });
  T sum = zero;
  for (const T &s : sums)
    sum += s;
  return sum;
}

/// What the parts of parallel_ranges find, in the order of [0, n) whatever the number of threads.
template <class T>
class Collected
{
public:
  Collected() : by_part(most_parts()) {}

  std::vector<T> &of(const std::size_t part) { return by_part[part]; }

  template <class Body>
  void for_each(Body &&body) const
  {
    for (const std::vector<T> &part : by_part)
      for (const T &value : part)
        body(value);
  }

  std::vector<T> all() const
  {
    std::vector<T> values;
    for (const std::vector<T> &part : by_part)
      values.insert(values.end(), part.begin(), part.end());
    return values;
  }

private:
  std::vector<std::vector<T>> by_part;
};

} // namespace bergamo
