#pragma once

#include "drivers/common/run/picture_series.h"
#include "drivers/pile_installation/installation.h"

#include <vector>

namespace bergamo::driver
{

/// What draws an installation: grains with their weights, mean pressure, displacement and the height at which they were
/// at first, the pile with what grains exert on it, and the elements. It must not outlive the installation.
std::vector<Picture> pictures_of(const Installation &installation);

} // namespace bergamo::driver
