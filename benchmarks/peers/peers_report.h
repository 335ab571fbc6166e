#pragma once

#include "benchmarks/peers/comparison.h"

#include <nlohmann/json.hpp>

#include <filesystem>

namespace bergamo::benchmark
{

/// Prints what the programs answer and how they differ. @param answers Bergamo's first
void print(const BulkCase &bulk, const std::vector<Answer> &answers);
void print(const BulkCase &bulk, const TimeComparison &times);

/// Writes FOLDER/CASE.csv, with a column for the time and one for each program.
void write_csv(const std::filesystem::path &folder, const BulkCase &bulk, const std::vector<Answer> &answers);
/// Writes FOLDER/CASE_times.csv, with a row for each program and turn.
void write_csv(const std::filesystem::path &folder, const BulkCase &bulk, const TimeComparison &times);

nlohmann::json to_json(const BulkCase &bulk, const std::vector<Answer> &answers);
nlohmann::json to_json(const BulkCase &bulk, const TimeComparison &times);

} // namespace bergamo::benchmark
