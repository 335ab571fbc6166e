#pragma once

#include "benchmarks/peers/comparison.h"

#include <nlohmann/json.hpp>

#include <filesystem>

namespace bergamo::benchmark
{

/// Prints differences and times of a case.
void print(const BulkCase &bulk, const Comparison &comparison);

/// Writes the answers as FOLDER/CASE.csv, with a column for the time and one for each program, and the times as
/// FOLDER/CASE_times.csv; only what was measured.
void write_csv(const std::filesystem::path &folder, const BulkCase &bulk, const Comparison &comparison);

nlohmann::json to_json(const BulkCase &bulk, const Comparison &comparison);

} // namespace bergamo::benchmark
