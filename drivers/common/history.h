#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace bergamo::driver
{

/// history.csv: one row a sample, numbers separated by commas, a header with the columns' names and units
/// ("time_s,stress_1_Pa"). The first column is the simulated time in seconds and named time_s.
///
/// A row is handed to the system in one piece, so a kill leaves at most the last row incomplete; continued()
/// drops such a row. Numbers read back as the very same doubles (shortest such text, at most 17 digits).
class History
{
public:
  /// Begins a file that has the header alone. Throws std::logic_error for bad column names, RunError when the file
  /// cannot be written.
  History(std::filesystem::path path, std::vector<std::string> columns);

  /// Goes on with a file: keeps the complete rows with time <= `last_time` [s] (the file is replaced atomically) and
  /// appends to them. Throws ConfigError when there is no such file or its columns are others, RunError when it is
  /// damaged.
  static History continued(std::filesystem::path path, std::vector<std::string> columns, double last_time);

  ~History();
  History(History &&other) noexcept;
  History &operator=(History &&) = delete;

  /// Appends one row: as many numbers as there are columns. Throws RunError when the disk refuses it.
  void append(std::span<const double> row);

  std::size_t n_columns() const { return columns.size(); }

private:
  struct Existing
  {
  };
  History(Existing, std::filesystem::path path, std::vector<std::string> columns);
  void open();

  std::filesystem::path path;
  std::vector<std::string> columns;
  int descriptor = -1;
};

} // namespace bergamo::driver
