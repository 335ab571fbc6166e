#pragma once

#include "coupling/model/model.h"

namespace bergamo::coupling
{

/// Kinetic and stored energies, losses, less the works of all movers of a model [J]: in exact arithmetic it stays what
/// it was, but for what couplings store and loads from outside do. Read between kick() and drift().
inline double energy_balance(const Model &model)
{
  double sum = 0.;
  for (const auto &mover : model.movers())
    sum += mover->energy().balance();
  return sum;
}

} // namespace bergamo::coupling
