#pragma once

#include <omp.h>

/// Sets the number of threads for one test and puts it back at the end. One thread suits one or two grains: a team
/// costs more than it gains there.
class Threads
{
public:
  explicit Threads(const int n) : before(omp_get_max_threads()) { omp_set_num_threads(n); }
  ~Threads() { omp_set_num_threads(before); }
  Threads(const Threads &) = delete;
  Threads &operator=(const Threads &) = delete;

private:
  int before;
};
