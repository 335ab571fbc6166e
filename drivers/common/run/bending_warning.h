#pragma once

#include "drivers/common/progress.h"
#include "fe_dealii/moving_body.h"

namespace bergamo::driver
{

/// Warns where a body is so thin that its elements cannot bend as they should, see thin_layers().
/// @param remedy what the user may choose instead, e.g. "set Ground/bending elements = true"
void warn_of_thin_layers(const fe::MovingBody &body, const std::string &remedy, Progress &progress);

} // namespace bergamo::driver
