#pragma once

#include "drivers/common/run/state_visitor.h"

#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace bergamo::driver
{

/// Makes the file of that path. Throws RunError where it cannot be written.
using PictureWriter = std::function<void(const std::filesystem::path &)>;

/// A model's name, with which its files begin, and what writes them.
using Picture = std::pair<std::string, PictureWriter>;

/// Files of a run's models at several times, for ParaView: NAME_0000.vtu and so on of each model, and NAME.pvd, which
/// joins them.
class PictureSeries
{
public:
  explicit PictureSeries(std::filesystem::path f) : folder(std::move(f)) {}

  /// @param time simulated [s] @param models the same names at each time. Throws RunError where a file cannot be
  /// written
  void add(double time, const std::vector<Picture> &models);

  /// The times of the files that are there. @param name in the snapshot, one for each series of a run
  void visit(StateVisitor &visit, const std::string &name = "picture_times") { visit(name, times); }

private:
  std::filesystem::path folder;
  std::vector<double> times; ///< [s]
};

} // namespace bergamo::driver
