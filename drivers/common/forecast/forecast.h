#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace bergamo::driver
{

/// One stage of a run as far as it is known before it begins.
struct StageForecast
{
  std::string name;
  double n_steps = 0;
  bool is_exact = true;        ///< the steps; or what such a stage usually takes
  double time_step = 0;        ///< [s]
  double stable_step = 0;      ///< estimated, above which the motion diverges [s]; 0: not known
  double seconds_per_step = 0; ///< of the wall clock, by a trial
};

/// Files of one kind that a run leaves.
struct FileForecast
{
  std::string name;
  double count = 0;
  double bytes = 0; ///< of each
};

/// What a run will be, told before anything starts: --dry-run. Numbers that the packing decides are estimates.
struct Forecast
{
  double n_grains = 0;
  bool grains_are_exact = true;
  double n_contacts = 0; ///< estimated, at once
  double n_elements = 0, n_nodes = 0;
  std::string elements = "hexahedra"; ///< what they are
  double n_runs = 1;                  ///< samples of an ensemble; the numbers above are sums over them
  double n_side_by_side = 1;          ///< of these, each on a thread of its own
  std::vector<StageForecast> stages;  ///< of all runs
  std::vector<FileForecast> files;
  double bytes_of_memory = 0;       ///< at most at once, without the program itself
  std::vector<std::string> unknown; ///< what only the run can tell

  double n_steps() const;
  double seconds() const; ///< of the stages, on the wall clock
  double bytes() const;   ///< of the files

  /// Adds the files that every run has: parameters and summary, and a snapshot where the run is long enough for one.
  /// @param snapshot_interval [s]; @param bytes_of_snapshot of one
  void add_own_files(double snapshot_interval, double bytes_of_snapshot);
};

/// Bytes of a row of a table with so many columns.
double bytes_of_row(double n_columns);

/// Bytes that a grain with its contacts takes in memory and in a snapshot.
inline constexpr double bytes_of_grain = 1600;

} // namespace bergamo::driver
