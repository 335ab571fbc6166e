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

} // namespace bergamo::driver
