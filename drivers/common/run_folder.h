#pragma once

#include <filesystem>
#include <string>
#include <vector>

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
/// With `force`, open() moves what an earlier run left to the sub-folder previous_run, which replaces an older one: the
/// files of every run (parameters.prm, history.csv, summary.json, snapshot.h5, NAME_0000.vtu, NAME.pvd, plots/) and
/// those that the driver names. Files that no run writes stay where they are.
class RunFolder
{
public:
  /// Throws ConfigError with the remedy when the path is no folder, may not be written, is not empty (`fresh`), or has
  /// no snapshot.h5 (`restart`). Leaves the disk as it was.
  /// @param own names of the files and folders that the driver writes beside those of every run
  RunFolder(std::filesystem::path path, FolderMode mode, std::vector<std::string> own = {});

  /// The folder and mode that the command line asks for.
  explicit RunFolder(const CommandLine &command_line, std::vector<std::string> own = {});

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
  std::vector<std::string> own;
  int lock = -1; ///< descriptor of the locked folder
};

} // namespace bergamo::driver
