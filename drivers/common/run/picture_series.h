#pragma once

#include "drivers/common/run/state_visitor.h"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace bergamo::driver
{

/// Files of one model at several times, for ParaView: NAME_0000.vtu and so on, and NAME.pvd, which joins them.
class PictureSeries
{
public:
  PictureSeries(std::filesystem::path folder, std::string name);

  /// @param time simulated [s] @param write makes the file of that path. Throws RunError where a file cannot be written
  void add(double time, const std::function<void(const std::filesystem::path &)> &write);

  /// The times of the files that are there.
  void visit(StateVisitor &visit) { visit("pictures/" + name, times); }

private:
  std::string file_name(std::size_t number) const;

  std::filesystem::path folder;
  std::string name;
  std::vector<double> times; ///< [s]
};

} // namespace bergamo::driver
