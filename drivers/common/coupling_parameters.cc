#include "drivers/common/coupling_parameters.h"

namespace bergamo::driver
{

void declare_coupling(ParameterFile &file, coupling::CouplingParameters &coupling)
{
  file.add("Coupling", "penalty", coupling.penalty, "epsilon [Pa/m2]", Range::positive());
  file.add("Coupling", "projection", coupling.projection, "of the grains' displacements",
           {{"lumped", coupling::Projection::lumped}, {"consistent", coupling::Projection::consistent}});
  file.add("Coupling", "least weight", coupling.least_weight, "lower bound of the grains' weights in the overlap",
           {.lowest = 0, .highest = 1, .lowest_included = false});
}

} // namespace bergamo::driver
