#include "coupling/adapter/rigid_mover.h"

#include <limits>

namespace bergamo::coupling
{

double RigidMover::stable_step()
{
  return std::numeric_limits<double>::infinity();
}

MoverEnergy RigidMover::energy() const
{
  return {0.5 * (kinetic_before_ + body_.kinetic_energy()), 0., 0., body_.work()};
}

} // namespace bergamo::coupling
