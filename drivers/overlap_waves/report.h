#pragma once

#include "drivers/common/run/state_visitor.h"
#include "drivers/common/summary.h"
#include "drivers/overlap_waves/wave_column.h"

#include <array>
#include <filesystem>
#include <vector>

namespace bergamo::driver
{

/// What is kept of a pulse's way through a column.
struct PulseReport
{
  std::array<double, 3> sent{}, arrived{}; ///< kinetic energy of each part, once it is sent and in the end [J]
  double sent_work = 0.;                   ///< that has sent it, less what has left through the quiet boundary [J]
  std::vector<double> times;               ///< of the looks at the column [s]
  std::vector<double> velocities;          ///< of its layers, look by look [m/s]

  /// @name Once a pulse has been sent, in the end, and at any time: the velocities of the column's layers
  /// @{
  void take_sent(const WaveColumn &column);
  void take_arrived(const WaveColumn &column);
  void look(const WaveColumn &column);
  /// @}

  /// Shares of the pulse's energy, by twice the kinetic energies: a wave has as much of it as it stores.
  void add_figures(Summary &summary, const WaveParameters &parameters) const;

  void visit(StateVisitor &visit);
};

/// waves.csv: velocity over place, layer by layer of each look.
void write_waves(const std::filesystem::path &path, const PulseReport &report, const WaveColumn &column);

} // namespace bergamo::driver
