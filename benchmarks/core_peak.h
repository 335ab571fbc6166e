#pragma once

namespace bergamo::benchmark
{

/// What one core of this machine does at most, measured with the same packs and the same compiler.
struct CorePeak
{
  double operations = 0.; ///< of double precision in chains of multiply-adds in registers, a multiply-add two [1/s]
  double reading = 0.;    ///< through memory that is larger than the caches [byte/s]
};

/// Raises the peak to the best of several further tries, since whatever else the machine does only lowers them. Takes
/// about half a second.
void raise_core_peak(CorePeak &peak);

} // namespace bergamo::benchmark
