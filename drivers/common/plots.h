#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace bergamo::driver
{

/// One script with its arguments.
struct PlotJob
{
  std::string script; ///< of drivers/common/plots ("energy.py"), or of a driver ("strip_footing/plot.py")
  std::vector<std::string> arguments;
};

struct PlotResult
{
  std::vector<std::filesystem::path> pictures; ///< as the scripts report them
  std::vector<std::string> warnings;           ///< one a script that failed: its name and why
};

/// Draws the pictures, one script after the other, with Debian's Python (/usr/bin/python3). Pictures are an extra: a
/// script that fails, or takes longer than five minutes, becomes a warning. Ctrl-C ends the drawing.
PlotResult make_plots(const std::vector<PlotJob> &jobs);

} // namespace bergamo::driver
