#pragma once

#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

namespace bergamo::dem
{

/// From low to high.
struct Range
{
  double low, high;
};

namespace detail
{

inline constexpr double golden = 0.61803398874989485;

/// The larger of two places of a concave function that enclose its maximum come together until they are one, or, where
/// that is enough, until the function is positive at one of them.
template <class Function>
std::pair<double, double> climb(const Function &f, double a, double b, const bool stops_above_zero)
{
  double x1 = b - golden * (b - a), x2 = a + golden * (b - a), f1 = f(x1), f2 = f(x2);
  for (int i = 0; i < 80 && x1 < x2; ++i)
  {
    if (stops_above_zero && (f1 > 0. || f2 > 0.))
      break;
    if (f1 >= f2)
    {
      b = x2;
      x2 = x1;
      f2 = f1;
      x1 = b - golden * (b - a);
      f1 = f(x1);
    }
    else
    {
      a = x1;
      x1 = x2;
      f1 = f2;
      x2 = a + golden * (b - a);
      f2 = f(x2);
    }
  }
  return f1 >= f2 ? std::pair(x1, f1) : std::pair(x2, f2);
}

/// Root between a place where f <= 0 and one where f > 0, to 1e-13 of their distance.
template <class Function>
double root_between(const Function &f, const double low, const double high)
{
  std::uintmax_t iterations = 100;
  const auto [a, b] =
      boost::math::tools::toms748_solve(f, low, high, boost::math::tools::eps_tolerance<double>(44), iterations);
  return 0.5 * (a + b);
}

} // namespace detail

/// Largest value of a concave function on [a, b], by golden section.
template <class Function>
double largest_value(const Function &f, const double a, const double b)
{
  return std::max({f(a), f(b), detail::climb(f, a, b, false).second});
}

/// Where a concave function is positive in [a, b]: an interval, or nothing.
template <class Function>
std::optional<Range> positive_range(const Function &f, const double a, const double b)
{
  if (!(a < b))
    return {};
  const bool is_low = f(a) > 0., is_high = f(b) > 0.;
  if (is_low && is_high)
    return Range{a, b};
  double inside = is_low ? a : b;
  if (!is_low && !is_high)
  {
    const auto [x, value] = detail::climb(f, a, b, true);
    if (!(value > 0.))
      return {};
    inside = x;
  }
  return Range{is_low ? a : detail::root_between(f, a, inside), is_high ? b : detail::root_between(f, inside, b)};
}

} // namespace bergamo::dem
