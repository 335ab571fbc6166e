#include "drivers/common/coupling_parameters.h"

namespace bergamo::driver
{

void declare_coupling(ParameterFile &file, coupling::CouplingParameters &coupling)
{
  file.add("Coupling", "penalty", coupling.penalty, "epsilon, per volume of grains [Pa/m2]",
           Range::positive().usual(1e6, 1e18));
  file.add("Coupling", "projection", coupling.projection, "of the grains' displacements",
           {{"lumped", coupling::Projection::lumped}, {"consistent", coupling::Projection::consistent}});
  file.add("Coupling", "edge depth", coupling.edge.depth,
           "of the overlap's edge, where each grain is held by itself, in mean diameters of the grains; 0 for none",
           Range::between(0, 10));
  file.add("Coupling", "edge stiffness", coupling.edge.stiffness, "of the grains held at the edge, per volume [Pa/m2]",
           Range::positive().usual(1e6, 1e20));
  file.add("Coupling", "edge strength", coupling.edge.strength,
           "of the springs that hold them, over what the gradient of the weights takes from the grain: beyond it they "
           "slip, as neighbours would; 0: never",
           Range::non_negative());
  file.add("Coupling", "transfer time", coupling.transfer_time,
           "in which the continuum takes over what the gradient of the weights takes from the grains [s]",
           Range::positive().usual(1e-7, 1));
  file.add("Coupling", "renewal", coupling.renewal,
           "of the overlap with the grains that are there by then: after this motion of a grain relative to the "
           "continuum, in mean diameters; 0 for never",
           Range::non_negative());
  file.add(
      "Coupling", "surface reach", coupling.surface_reach,
      "of an overlap that comes to a free surface: grains up to here above the mesh belong to it, in mean diameters; "
      "0: those in elements alone, others weigh 1 at once",
      Range::between(0, 10));
  file.add("Coupling", "least weight", coupling.least_weight, "lower bound of the grains' weights in the overlap",
           {.lowest = 0, .highest = 1, .lowest_included = false});
}

} // namespace bergamo::driver
