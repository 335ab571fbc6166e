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
/// changes the disk and belongs after all validation, right before the first file is written. Other runs are kept out
/// of the folder for the life of this object, from the constructor on where the folder is there already.
///
/// With `force`, open() moves what an earlier run left to the sub-folder previous_run, which replaces an older one: the
/// files of every run (parameters.prm, history.csv, summary.json, snapshot.h5, NAME_0000.vtu, NAME.pvd, plots/) and
/// those that the driver names. Files that no run writes stay where they are.
class RunFolder
{
public:
  /// Throws ConfigError with the remedy when the path is no folder, may not be written, is not empty (`fresh`), or has
  /// no snapshot.h5 (`restart`), or when another run is writing there. Leaves the disk as it was.
  /// @param own names of the files and folders that the driver writes beside those of every run
  RunFolder(std::filesystem::path path, FolderMode mode, std::vector<std::string> own = {});

  /// The folder and mode that the command line asks for.
  explicit RunFolder(const CommandLine &command_line, std::vector<std::string> own = {});

  /// Makes the folder, clears it as the mode says, removes parts that a killed run left. Throws ConfigError when
  /// another run is writing there, or has written there since the constructor (`fresh`), RunError when the system
  /// refuses.
  void open();

  const std::filesystem::path &path() const { return folder; }
  std::filesystem::path file(const std::string &name) const { return folder / name; }
  std::filesystem::path parameters() const { return file("parameters.prm"); }
  std::filesystem::path history() const { return file("history.csv"); }
  std::filesystem::path summary() const { return file("summary.json"); }
  std::filesystem::path snapshot() const { return file("snapshot.h5"); }

private:
  /// Closed at the end, also where the constructor of the folder throws.
  struct Descriptor
  {
    explicit Descriptor(int n = -1) : number(n) {}
    ~Descriptor();
    Descriptor(const Descriptor &) = delete;
    Descriptor &operator=(Descriptor &&other) noexcept;

    int number;
  };

  void keep_others_out();
  void require_empty() const;

  std::filesystem::path folder;
  FolderMode mode;
  std::vector<std::string> own;
  Descriptor lock; ///< of the folder
};

} // namespace bergamo::driver
