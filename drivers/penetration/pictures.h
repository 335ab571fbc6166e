#pragma once

#include "drivers/common/run/picture_series.h"
#include "drivers/penetration/intrusion.h"

#include <vector>

namespace bergamo::driver
{

/// What draws a penetration: grains with their mean pressure and how far they have sunk since the start, the intruder
/// with what grains exert on it, all contacts as lines. It must not outlive the intrusion.
std::vector<Picture> pictures_of(const Intrusion &intrusion);

} // namespace bergamo::driver
