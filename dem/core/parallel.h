#pragma once

#include <cstddef>
#include <omp.h>
#include <vector>
#if defined(__SANITIZE_THREAD__)
#include <sanitizer/tsan_interface.h>
#endif

namespace bergamo::dem
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

/// Calls body(thread, begin, end) once a thread for contiguous ranges that make up [0, n) in the order of the threads.
/// Runs alone where there is too little work for a team. ThreadSanitizer looks into the bodies, but not at how the
/// compiler hands them to the threads: that lies within the region's own barrier.
template <class Body>
[[gnu::no_sanitize("thread")]] void parallel_ranges(const std::size_t n, const std::size_t least_per_thread,
                                                    Body &&body)
{
  const bool is_worthwhile = n >= 2 * least_per_thread;
  team_begins.leave();
#pragma omp parallel if (is_worthwhile)
  {
    team_begins.enter();
    const std::size_t thread = omp_get_thread_num(), n_threads = omp_get_num_threads();
    const std::size_t begin = n * thread / n_threads, end = n * (thread + 1) / n_threads;
    if (begin < end)
      body(thread, begin, end);
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

/// What the threads of parallel_ranges find, in the order of the ranges whatever their number.
template <class T>
class Collected
{
public:
  Collected() : by_thread(omp_get_max_threads()) {}

  std::vector<T> &of(const std::size_t thread) { return by_thread[thread]; }

  template <class Body>
  void for_each(Body &&body) const
  {
    for (const std::vector<T> &part : by_thread)
      for (const T &value : part)
        body(value);
  }

private:
  std::vector<std::vector<T>> by_thread;
};

} // namespace bergamo::dem
