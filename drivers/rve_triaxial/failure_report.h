#pragma once

#include "drivers/rve_triaxial/sample.h"

#include <memory>
#include <string>
#include <vector>

namespace bergamo::driver
{

/// Which samples failed, why, and how to have them all the same; empty where none did.
std::string failure_report(const RveParameters &parameters, const std::vector<std::shared_ptr<Sample>> &samples);

} // namespace bergamo::driver
