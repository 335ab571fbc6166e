#pragma once

#include <filesystem>

namespace bergamo::driver
{

struct CommandLine;

/// What to do with a folder that already holds files.
enum class FolderMode
{
  fresh,  ///< refuse it
  force,  ///< move the earlier run aside
  restart ///< go on with the run in it
};

/// The folder that one run writes.
///
/// Made in two steps, so that a mistake in the parameters never costs results: the constructor only checks, open()
/// changes the disk and belongs after all validation, right before the first file is written.
///
/// With `force`, open() moves what an earlier run left (parameters.prm, history.csv, summary.json, snapshot.h5,
/// grains_*.vtu, continuum_*.vtu, *.pvd, plots/, of an ensemble samples/ and ensemble.csv, of a fit
/// fit_mohr_coulomb.json, continuum.prm, curves_*.csv) to the sub-folder previous_run, which replaces an older
/// previous_run. Files that no run writes stay where they are.
class RunFolder
{
public:
  /// Throws ConfigError with the remedy when the path is no folder, may not be written, is not empty (`fresh`), or has
  /// no snapshot.h5 (`restart`). Leaves the disk as it was.
  RunFolder(std::filesystem::path path, FolderMode mode);

  /// The folder and mode that the command line asks for.
  explicit RunFolder(const CommandLine &command_line);

  ~RunFolder();
  RunFolder(const RunFolder &) = delete;
  RunFolder &operator=(const RunFolder &) = delete;

  /// Makes the folder, clears it as the mode says, removes parts that a killed run left, and keeps other runs out of it
  /// for the life of this object. Throws ConfigError when another run is writing there, RunError when the system
  /// refuses.
  void open();

  const std::filesystem::path &path() const { return folder; }
  std::filesystem::path file(const std::string &name) const { return folder / name; }
  std::filesystem::path parameters() const { return file("parameters.prm"); }
  std::filesystem::path history() const { return file("history.csv"); }
  std::filesystem::path summary() const { return file("summary.json"); }
  std::filesystem::path snapshot() const { return file("snapshot.h5"); }

private:
  std::filesystem::path folder;
  FolderMode mode;
  int lock = -1; ///< descriptor of the locked folder
};

} // namespace bergamo::driver
