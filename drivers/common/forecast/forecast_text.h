#pragma once

#include "drivers/common/forecast/forecast.h"

#include <filesystem>

namespace bergamo::driver
{

/// What this machine has, asked of the system; 0: it does not say.
struct MachineRoom
{
  double bytes_of_memory = 0; ///< that are free
  double bytes_of_disk = 0;   ///< free where the run's folder would be
  int n_threads = 1;
};

/// Looks alone: the folder may be missing, and stays so.
MachineRoom room_for(const std::filesystem::path &folder);

/// Lines for people: grains, contacts, elements, steps, time, memory, disk, and what is not known.
/// @param folder that the run would write
std::string text_of(const Forecast &forecast, const std::filesystem::path &folder, const MachineRoom &room);

/// 1234567 as "1.23 MB".
std::string text_of_bytes(double bytes);

} // namespace bergamo::driver
