#pragma once

#include <limits>
#include <string>

namespace bergamo::driver
{

/// The numbers that a parameter may have; infinity and NaN are never among them.
struct Range
{
  double lowest = -std::numeric_limits<double>::infinity();
  double highest = std::numeric_limits<double>::infinity();
  bool lowest_included = true;
  bool highest_included = true;

  static Range any() { return {}; }
  static Range positive() { return above(0); }
  static Range non_negative() { return at_least(0); }
  static Range above(const double limit) { return {.lowest = limit, .lowest_included = false}; }
  static Range at_least(const double limit) { return {.lowest = limit}; }
  static Range at_most(const double limit) { return {.highest = limit}; }
  static Range below(const double limit) { return {.highest = limit, .highest_included = false}; }
  /// Both limits included.
  static Range between(const double lowest, const double highest) { return {.lowest = lowest, .highest = highest}; }
  /// Both limits excluded.
  static Range strictly_between(const double lowest, const double highest) { return {lowest, highest, false, false}; }

  bool contains(double number) const;

  /// " >= 0 and < 0.5" for messages; empty when any number is allowed.
  std::string text() const;
};

} // namespace bergamo::driver
