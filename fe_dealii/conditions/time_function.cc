#include "fe_dealii/conditions/time_function.h"

#include "dem/core/error.h"

#include <deal.II/base/function_parser.h>
#include <deal.II/base/point.h>

#include <cctype>
#include <cmath>
#include <iostream>
#include <numbers>
#include <sstream>
#include <vector>

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

[[noreturn]] void refuse(const std::string &text, const std::string &reason)
{
  throw ConfigError("'" + text + "' is no function of the time; " + reason);
}

bool is_of_name(const char c)
{
  return std::isalnum(static_cast<unsigned char>(c)) || c == '_';
}

/// Refuses what the parser reads in another way than it is meant: it takes the last of several expressions with commas,
/// assigns to t, and draws new random numbers at every call.
void refuse_traps(const std::string &text)
{
  std::vector<bool> is_call; // of the brackets that are open
  for (std::size_t k = 0; k < text.size(); ++k)
  {
    const char before = k > 0 ? text[k - 1] : ' ', after = k + 1 < text.size() ? text[k + 1] : ' ';
    if (text[k] == '(')
      is_call.push_back(is_of_name(before));
    else if (text[k] == ')' && !is_call.empty())
      is_call.pop_back();
    else if (text[k] == ',' && (is_call.empty() || !is_call.back() || (std::isdigit(before) && std::isdigit(after))))
      refuse(text, "write numbers with a point, as 0.5, and arguments with a space behind the comma, as min(t, 1)");
    else if (text[k] == '=' && std::string("=<>!").find(before) == std::string::npos && after != '=')
      refuse(text, "it assigns; compare with ==");
  }
  for (const std::string random : {"rand", "rand_seed"})
    for (std::size_t k = text.find(random); k != std::string::npos; k = text.find(random, k + 1))
      if ((k == 0 || !is_of_name(text[k - 1])) && !is_of_name((text + " ")[k + random.size()]))
        refuse(text, random + "() differs from call to call; write an expression of t that does not");
}

} // namespace

struct TimeFunction::Parser
{
  dealii::FunctionParser<1> function;
};

TimeFunction::TimeFunction(const std::string &text) : text_(text), parser_(std::make_unique<Parser>())
{
  refuse_traps(text);
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
    refuse(text, "write an expression of t in seconds, such as -0.01*min(t, 1)");
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
