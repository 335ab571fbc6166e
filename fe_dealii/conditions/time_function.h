#pragma once

#include <memory>
#include <string>

namespace bergamo::fe
{

/// A number over time, read from a text such as "-0.01*min(t, 1)": t is the time [s]; numbers, + - * / ^, pi, and the
/// functions that deal.II's FunctionParser knows (sin, exp, min, if, ...).
class TimeFunction
{
public:
  /// Throws ConfigError for a text that is no such expression, and for what would be read in another way than it is
  /// meant: a comma in a number, an assignment, a random number.
  explicit TimeFunction(const std::string &text);
  TimeFunction(double constant);
  TimeFunction(TimeFunction &&) noexcept;
  TimeFunction &operator=(TimeFunction &&) noexcept;
  ~TimeFunction();

  /// Throws RunError where the expression is not finite.
  double operator()(double time) const;

  const std::string &text() const { return text_; }

private:
  struct Parser;
  std::string text_;
  std::unique_ptr<Parser> parser_;
};

} // namespace bergamo::fe
