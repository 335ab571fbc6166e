#include "fe_dealii/conditions/time_function.h"

#include "dem/core/error.h"

#include <deal.II/base/function_parser.h>
#include <deal.II/base/point.h>

#include <cmath>
#include <iostream>
#include <numbers>
#include <sstream>

namespace bergamo::fe
{
namespace
{

std::string text_of(const double constant)
{
  std::ostringstream text;
  text.precision(17);
  text << constant;
  return text.str();
}

} // namespace

struct TimeFunction::Parser
{
  dealii::FunctionParser<1> function;
};

TimeFunction::TimeFunction(const std::string &text) : text_(text), parser_(std::make_unique<Parser>())
{
  // deal.II writes what its parser says to std::cerr beside the exception: one mistake, one message.
  struct Silence
  {
    std::streambuf *const before = std::cerr.rdbuf(nullptr);
    ~Silence()
    {
      std::cerr.rdbuf(before);
      std::cerr.clear();
    }
  };
  try
  {
    const Silence silence;
    parser_->function.initialize("t", text, {{"pi", std::numbers::pi}});
    parser_->function.value(dealii::Point<1>(0.));
  }
  catch (const dealii::ExceptionBase &)
  {
    throw ConfigError("'" + text + "' is no function of the time; write an expression of t in seconds, such as " +
                      "-0.01*min(t, 1)");
  }
}

TimeFunction::TimeFunction(const double constant) : TimeFunction(text_of(constant)) {}
TimeFunction::TimeFunction(TimeFunction &&) noexcept = default;
TimeFunction &TimeFunction::operator=(TimeFunction &&) noexcept = default;
TimeFunction::~TimeFunction() = default;

double TimeFunction::operator()(const double time) const
{
  const double value = parser_->function.value(dealii::Point<1>(time));
  if (!std::isfinite(value))
  {
    std::ostringstream message;
    message << "'" << text_ << "' is " << value << " at t = " << time << " s; choose a function that stays finite";
    throw RunError(message.str());
  }
  return value;
}

} // namespace bergamo::fe
