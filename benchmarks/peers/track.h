#pragma once

#include "dem/core/types.h"

#include <cstdint>
#include <filesystem>
#include <vector>

namespace bergamo::benchmark
{

/// Where beads are at a moment; those that were taken out are missing.
struct Frame
{
  double time = 0.; ///< [s]
  std::vector<std::int64_t> id;
  std::vector<Vec3> position; ///< [m]
};

/// A run's frames, in the order of time.
using Track = std::vector<Frame>;

/// Reads what LIGGGHTS' `dump custom id x y z` writes, and yade_run.py after its example. Throws RunError for a file
/// that is missing or of another form.
/// @param time_step [s]; @param first_id that the file gives to the bead of id 0
Track read_track(const std::filesystem::path &path, double time_step, std::int64_t first_id);

} // namespace bergamo::benchmark
