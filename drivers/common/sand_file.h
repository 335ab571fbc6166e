#pragma once

#include "dem/io/grain_file.h"
#include "drivers/common/sand_parameters.h"

namespace bergamo::driver
{

/// The grains of Sand/grains file, of one material. Throws ConfigError for a file that read_grains() refuses, for a
/// half-axis beyond Sand/smallest and largest half-axis (steps and meshes follow these), and for a grain that reaches
/// out of the box by more than a tenth of its smallest half-axis. @param box [m]; @param grain their mineral
dem::GrainsOfFile read_sand(const SandParameters &sand, const dem::Box &box, const dem::Material &grain);

} // namespace bergamo::driver
