#pragma once

#include "drivers/common/run/state_visitor.h"

#include <cstdint>

namespace bergamo::driver
{

/// What the balance of a run's energies fails to close by, kept of its samples.
class EnergyResidual
{
public:
  /// Takes in a sample. @param balance of the energies, which would stay what it was at the first sample [J]
  /// @param work done on the models since the start [J]; @return present()
  double add(double balance, double work);

  double present() const { return present_; } ///< of the last sample since the first one [J]

  /// The largest over the largest work; 0 without work.
  double relative() const { return largest_work_ > 0 ? largest_ / largest_work_ : 0; }

  void visit(StateVisitor &visit);

private:
  std::int64_t n_samples_ = 0;
  double first_balance_ = 0, present_ = 0, largest_ = 0, largest_work_ = 0;
};

} // namespace bergamo::driver
