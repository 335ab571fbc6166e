#include "fe_dealii/body_energy.h"

#include "dem/core/error.h"

#include <cmath>
#include <sstream>

namespace bergamo::fe
{

void require_bounded(const BodyEnergy &energy, const std::string &what, const std::string &remedy)
{
  constexpr double tolerance = 1e-3;
  const double put_in = std::abs(energy.boundary_work) + std::abs(energy.gravity_work) +
                        std::abs(energy.external_work) + std::abs(energy.initial);
  std::ostringstream message;
  message << "the run diverged: " << what;
  if (!std::isfinite(energy.residual()))
    message << " has energies that are no finite numbers";
  else if (energy.kinetic < -tolerance * (put_in + std::abs(energy.elastic)))
    message << " has a negative kinetic energy, " << energy.kinetic << " J";
  else if (-energy.stiffness_loss > put_in)
    message << " got " << -energy.stiffness_loss << " J from the change of its stiffness, more than the " << put_in
            << " J that were put in";
  else
    return;
  message << "; choose " << remedy;
  throw RunError(message.str());
}

} // namespace bergamo::fe
