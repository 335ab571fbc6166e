#pragma once

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <functional>
#include <string>

namespace bergamo::benchmark
{

/// A line for who waits, beside the figures on the standard output.
void log_line(const std::string &line);

/// @return false if only help was asked for, which is printed then; throws ConfigError for a mistake
bool parse_arguments(CLI::App &app, int argc, const char *const *argv);

/// Makes the folder of --cache. Throws ConfigError if it cannot be made.
void make_cache(const std::filesystem::path &folder);

/// Runs `measure` and writes what it returns to a file, whole; no path, no file. The file is opened first, so that a
/// wrong path is known before the work.
void write_figures(const std::filesystem::path &json, const std::function<nlohmann::json()> &measure);

/// Runs a program. @return its exit status: 0 done, 1 the run failed, 2 a mistake on the command line
int run_program(const std::string &name, const std::function<void()> &run);

} // namespace bergamo::benchmark
