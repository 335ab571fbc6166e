#include "drivers/common/parameter_range.h"

#include "drivers/common/number_text.h"

#include <cmath>

namespace bergamo::driver
{

bool Range::contains(const double number) const
{
  if (!std::isfinite(number))
    return false;
  const bool above_lowest = lowest_included ? number >= lowest : number > lowest;
  const bool below_highest = highest_included ? number <= highest : number < highest;
  return above_lowest && below_highest;
}

Range Range::usual(const double lowest_usual, const double highest_usual) const
{
  Range range = *this;
  range.usual_lowest = lowest_usual;
  range.usual_highest = highest_usual;
  return range;
}

bool Range::is_usual(const double number) const
{
  return contains(number) && (number == 0. || (number >= usual_lowest && number <= usual_highest));
}

std::string Range::text() const
{
  std::string text;
  if (std::isfinite(lowest))
    text += (lowest_included ? " >= " : " > ") + short_text(lowest, 15);
  if (std::isfinite(lowest) && std::isfinite(highest))
    text += " and";
  if (std::isfinite(highest))
    text += (highest_included ? " <= " : " < ") + short_text(highest, 15);
  return text;
}

std::string Range::usual_text() const
{
  const std::string from = short_text(usual_lowest), to = short_text(usual_highest);
  if (std::isfinite(usual_lowest) && std::isfinite(usual_highest))
    return from + " to " + to;
  if (std::isfinite(usual_highest))
    return "at most " + to;
  return std::isfinite(usual_lowest) ? "at least " + from : "";
}

} // namespace bergamo::driver
