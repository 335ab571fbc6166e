#pragma once

#include "drivers/common/run/state_visitor.h"

#include <filesystem>
#include <functional>
#include <future>
#include <string>

namespace bergamo::driver
{

/// One list of all that a restart needs, by name, for writing and for reading.
using Visit = std::function<void(StateVisitor &)>;

/// The snapshot of a run: its state to the last bit, and the parameters that it belongs to. May be used by several
/// threads at a time: HDF5 gets them one by one.
class Snapshot
{
public:
  /// @param kind what the snapshot is of ("strip footing"); files of another kind are refused
  /// @param parameters resolved text of all parameters that it depends on
  /// @param remedy what a user with others is told to do
  Snapshot(std::filesystem::path path, std::string kind, std::string parameters,
           std::string remedy = "restart with those of the run, or start anew in another folder");

  const std::filesystem::path &path() const { return path_; }

  /// Puts the file in place, whole or not at all. Throws RunError as ArchiveWriter does.
  void write(const Visit &visit) const;

  /// The same, of which only the visit happens here: the disk is left to another thread. Its errors come at the next
  /// call, whichever it is; until it is done the file from before stays.
  void write_behind(const Visit &visit);

  /// Until what was written behind is in place. Throws what came of it.
  void wait() const;

  /// Throws RunError for a damaged or foreign file, ConfigError, naming the first difference, where the parameters are
  /// others than those of the run that wrote it.
  void read(const Visit &visit) const;

private:
  std::function<void()> collect(const Visit &visit) const;

  std::filesystem::path path_;
  std::string kind_, parameters_, remedy_;
  mutable std::future<void> behind_; // on its way to the disk; its end waits for that
};

} // namespace bergamo::driver
