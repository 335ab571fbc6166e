#pragma once

#include <string>

namespace bergamo::driver
{

/// Of the machine, as the system calls it; "unknown" where it does not.
std::string processor_name();

} // namespace bergamo::driver
