#pragma once

#include "fe_dealii/explicit_body.h"

#include <cstddef>
#include <cstring>

namespace bergamo::fe
{

/// Whether two bodies are in the same state, to the last bit.
inline bool same_bits(ExplicitBody &a, ExplicitBody &b)
{
  const auto x = a.state(), y = b.state();
  bool same = x.size() == y.size();
  for (std::size_t k = 0; same && k < x.size(); ++k)
    same = x[k].second.size() == y[k].second.size() &&
           std::memcmp(x[k].second.data(), y[k].second.data(), x[k].second.size_bytes()) == 0;
  return same;
}

} // namespace bergamo::fe
