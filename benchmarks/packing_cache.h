#pragma once

#include "benchmarks/settled_packing.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

namespace bergamo::benchmark
{

/// A settled packing from a folder, or a new one that is then kept there. A file that this version cannot read, or that
/// does not give back the state it was written in, is replaced. @param log is given a line at each stage
/// @throws RunError if the folder cannot be written to
std::unique_ptr<dem::Simulation> cached_packing(const std::filesystem::path &folder, const PackingRecipe &recipe,
                                                const std::function<void(const std::string &)> &log);

} // namespace bergamo::benchmark
