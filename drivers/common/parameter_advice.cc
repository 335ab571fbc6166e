#include "drivers/common/parameter_advice.h"

#include "drivers/common/number_text.h"

#include <cmath>
#include <functional>
#include <numbers>
#include <sstream>

namespace bergamo::driver
{

namespace
{

const std::string coefficient = "coefficient of friction";

constexpr double degree = std::numbers::pi / 180.;

/// A unit in which people think, and what a number in it is in the parameter's own.
struct OtherUnit
{
  std::string own, other;
  std::function<double(double)> converted;
};

std::function<double(double)> times(const double factor)
{
  return [factor](const double number) { return factor * number; };
}

/// The parameter's unit; a coefficient of friction has one of its own, since angles are taken for it.
std::string kind_of(const ParameterEntry &parameter)
{
  return parameter.unit().empty() && parameter.name.find("friction") != std::string::npos ? coefficient
                                                                                          : parameter.unit();
}

/// The likeliest first.
const std::vector<OtherUnit> &other_units()
{
  static const std::vector<OtherUnit> units = {
      {"Pa", "kPa", times(1e3)},
      {"Pa", "MPa", times(1e6)},
      {"Pa", "GPa", times(1e9)},
      {"m", "mm", times(1e-3)},
      {"m", "µm", times(1e-6)},
      {"m", "cm", times(1e-2)},
      {"m/s", "mm/s", times(1e-3)},
      {"s", "ms", times(1e-3)},
      {"s", "µs", times(1e-6)},
      {"kg/m3", "g/cm3", times(1e3)},
      {"kg/m3", "kN/m3", times(1e3 / 9.81)}, // a unit weight
      {"degree", "radian", times(1. / degree)},
      {"degrees", "radian", times(1. / degree)},
      {coefficient, "degrees of a friction angle", [](const double angle) { return std::tan(angle * degree); }},
      {"", "%", times(1e-2)},
  };
  return units;
}

std::string with_unit(const std::string &text, const std::string &unit)
{
  return text + (unit.empty() ? "" : " " + unit);
}

std::string remedy(const double number, const ParameterEntry &parameter)
{
  std::vector<std::string> meant;
  for (const OtherUnit &unit : other_units())
    if (unit.own == kind_of(parameter) && parameter.binding.range.is_usual(unit.converted(number)) && meant.size() < 2)
      meant.push_back(with_unit(short_text(unit.converted(number)), parameter.unit()) + " (" + short_text(number) +
                      " " + unit.other + ")");
  std::string text;
  for (const std::string &value : meant)
    text += (text.empty() ? "" : " or ") + value;
  return text.empty() ? "check the value" + std::string(parameter.unit().empty() ? "" : " and its unit")
                      : "did you mean " + text + "?";
}

/// The first number of a value, which may be a list of them, that is not usual.
std::string warning(const ParameterEntry &parameter)
{
  std::istringstream stream(parameter.binding.text());
  for (std::string part; std::getline(stream, part, ',');)
  {
    const auto number = parse_number(trimmed(part));
    if (!number || parameter.binding.range.is_usual(*number))
      continue;
    const std::string unit = parameter.unit();
    return parameter.path + " is " + with_unit(short_text(*number), unit) + " (" + parameter.place + "), where " +
           with_unit(parameter.binding.range.usual_text(), unit) + " is usual; " + remedy(*number, parameter);
  }
  return "";
}

} // namespace

std::vector<std::string> unusual_values(const std::span<const ParameterEntry> parameters)
{
  std::vector<std::string> warnings;
  for (const ParameterEntry &parameter : parameters)
    if (!parameter.place.empty() && !parameter.binding.range.usual_text().empty())
      if (std::string text = warning(parameter); !text.empty())
        warnings.push_back(std::move(text));
  return warnings;
}

} // namespace bergamo::driver
