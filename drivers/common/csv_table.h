#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace bergamo::driver
{

/// Columns of numbers of a comma-separated file, by the names in its header.
struct CsvTable
{
  std::filesystem::path path;
  std::map<std::string, std::vector<double>> columns; ///< each with one number a row
  std::size_t n_rows = 0;

  const std::vector<double> &operator[](const std::string &name) const { return columns.at(name); }
};

/// Reads the named columns of a file as History writes it: a header, then rows of numbers, no quotes. Other columns may
/// hold anything and are left out; so is a last row without its line break, which a killed program may leave behind.
/// Throws ConfigError, naming the file, the line and the remedy, for a file that cannot be read or is empty, for a
/// missing column, a row that is too short or too long, and a value that is no finite number.
CsvTable read_csv(const std::filesystem::path &path, const std::vector<std::string> &wanted);

/// Writes rows of numbers below a header of their names, whole or not at all. Numbers read back as the very same
/// doubles. Throws RunError where the file cannot be written.
void write_csv(const std::filesystem::path &path, const std::vector<std::string> &names,
               const std::vector<std::vector<double>> &rows);

/// Numbers by the names of their columns: one list for writing and for reading.
using FigureList = std::vector<std::pair<std::string, double *>>;

std::vector<std::string> names_of(const FigureList &figures);
std::vector<double> values_of(const FigureList &figures);

/// Reads the first row of a file into the list. Throws ConfigError as read_csv() does.
void read_figures(const std::filesystem::path &path, const FigureList &figures);

} // namespace bergamo::driver
