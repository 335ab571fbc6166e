#pragma once

#include "drivers/common/number_text.h"

#include <initializer_list>
#include <string>

namespace bergamo::driver
{

/// The numbers as a line of a CSV file, such that they read back as they are.
inline std::string row_of(const std::initializer_list<double> values)
{
  std::string row;
  for (const double value : values)
  {
    if (!row.empty())
      row += ',';
    row += exact_text(value);
  }
  row += '\n';
  return row;
}

} // namespace bergamo::driver
