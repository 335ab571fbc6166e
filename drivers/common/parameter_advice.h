#pragma once

#include "drivers/common/parameter_entry.h"

#include <span>
#include <string>
#include <vector>

namespace bergamo::driver
{

/// A line for each value that was set outside of the usual range of its parameter: thing, value and place, what is
/// usual, and what was meant, where the number makes a usual value in another unit ("did you mean 5e+10 Pa (50 GPa)?").
/// Values that nobody has set are not looked at.
std::vector<std::string> unusual_values(std::span<const ParameterEntry> parameters);

} // namespace bergamo::driver
