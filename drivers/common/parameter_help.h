#pragma once

#include "drivers/common/parameter_entry.h"

#include <span>
#include <string>

namespace bergamo::driver
{

/// What is to be known of one parameter ("Section/Name"), of all in a section with those in it, or of all with a name
/// ("Name"): meaning, unit, default, what is allowed and usual, the value in force and where it was set. Throws
/// ConfigError with the nearest known names where there is nothing of this name.
std::string explained(std::span<const ParameterEntry> parameters, const std::string &topic);

} // namespace bergamo::driver
