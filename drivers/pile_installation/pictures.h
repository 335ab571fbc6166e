#pragma once

#include "drivers/common/run/picture_series.h"
#include "drivers/pile_installation/installation.h"

#include <vector>

namespace bergamo::driver
{

/// What draws an installation: grains with their weights, mean pressure, displacement and the height at which they were
/// at first, all contacts as lines, the pile with what grains exert on it, the elements, and the fields of solid
/// fraction and stress. It must not outlive the installation and its parameters.
std::vector<Picture> pictures_of(const Installation &installation, const InstallationParameters &parameters);

} // namespace bergamo::driver
