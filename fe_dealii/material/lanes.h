#pragma once

#include <cmath>
#include <cstddef>

/// What lets a constitutive law run on a double or on a pack of doubles of GCC's or Clang's vector extension: one
/// source for a single point and for the eight points of an element.
namespace bergamo::fe::lanes
{

inline double square_root(const double x)
{
  return std::sqrt(x);
}
inline double logarithm(const double x)
{
  return std::log(x);
}
inline double exponential(const double x)
{
  return std::exp(x);
}
inline double power(const double x, const double exponent)
{
  return std::pow(x, exponent);
}
inline bool any(const bool condition)
{
  return condition;
}

namespace detail
{
template <class Pack, class Function>
Pack each(const Pack &x, const Function &function)
{
  Pack result = x;
  for (std::size_t i = 0; i < sizeof(Pack) / sizeof(double); ++i)
    result[i] = function(x[i]);
  return result;
}
} // namespace detail

template <class Pack>
Pack square_root(const Pack &x)
{
  return detail::each(x, [](const double lane) { return std::sqrt(lane); });
}

template <class Pack>
Pack logarithm(const Pack &x)
{
  return detail::each(x, [](const double lane) { return std::log(lane); });
}

template <class Pack>
Pack exponential(const Pack &x)
{
  return detail::each(x, [](const double lane) { return std::exp(lane); });
}

/// x^exponent for x > 0.
template <class Pack>
Pack power(const Pack &x, const double exponent)
{
  return detail::each(x, [exponent](const double lane) { return std::pow(lane, exponent); });
}

template <class Mask>
bool any(const Mask &condition)
{
  bool found = false;
  for (std::size_t i = 0; i < sizeof(Mask) / sizeof(double); ++i)
    found |= condition[i] != 0;
  return found;
}

} // namespace bergamo::fe::lanes
