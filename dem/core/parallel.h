#pragma once

#include <cstddef>

namespace bergamo::dem
{

/// Calls body(i) for i in [0, n). Each call may write only what belongs to i: then there is no race and
/// the result does not depend on the number of threads.
template <class Body>
void parallel_for(const std::size_t n, Body &&body)
{
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < n; ++i)
    body(i);
}

} // namespace bergamo::dem
