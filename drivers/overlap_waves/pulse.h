#pragma once

#include "drivers/overlap_waves/lattice.h"

namespace bergamo::driver
{

/// A wave train sent into a column by a stress on its end: s(t) = a sin^2(pi t / T) sin(w t), 0 <= t <= T.
struct Pulse
{
  Wave wave = Wave::compression;
  double frequency = 0.; ///< w [1/s]
  double duration = 0.;  ///< T [s]
  double amplitude = 0.; ///< a [Pa]
  double stress(double time) const;
};

} // namespace bergamo::driver
