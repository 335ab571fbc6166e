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
  double usual_lowest = -std::numeric_limits<double>::infinity(); ///< sensible values, both limits included
  double usual_highest = std::numeric_limits<double>::infinity();

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

  /// The same numbers, of which those between the limits are usual. What lies outside is taken, with a warning: a range
  /// catches other units and slips, so it is as wide as physics allows.
  Range usual(double lowest, double highest) const;

  bool contains(double number) const;

  /// Whether a number needs no warning. So does 0 where it is allowed: it turns off what the parameter is of.
  bool is_usual(double number) const;

  /// " >= 0 and < 0.5" for messages; empty when any number is allowed.
  std::string text() const;

  /// "1e+09 to 1e+12" or "at most 1"; empty when none was given.
  std::string usual_text() const;
};

} // namespace bergamo::driver
