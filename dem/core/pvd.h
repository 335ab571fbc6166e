#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <utility>

namespace bergamo
{

/// Collection file that ParaView opens as a series over time: pairs of time [s] and file name (relative to the
/// folder of `path`). Written aside and renamed, so that a series can be opened while the run goes on.
/// Throws RunError where the file cannot be written.
void write_pvd(const std::filesystem::path &path, std::span<const std::pair<double, std::string>> frames);

} // namespace bergamo
