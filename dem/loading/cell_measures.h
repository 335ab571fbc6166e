#pragma once

#include "dem/loading/cell_loading.h"
#include "dem/measure/assembly_measures.h"
#include "dem/simulation/simulation.h"

namespace bergamo::dem
{

/// What a periodic cell says of itself at one step of its loading: a row of a history.
struct CellMeasures
{
  double time = 0.;           ///< [s]
  Vec3 strain = Vec3::Zero(); ///< since the stage began
  double solid_fraction = 0.;
  double inertial_number = 0.; ///< of the fastest axis
  double rattler_fraction = 0.;
  AssemblyMeasures assembly;
  double largest_overlap = 0.; ///< over the smaller bounding radius
  GrainEnergy energy;
};

/// To be called between CellLoading::prepare() and Simulation::integrate(). Throws RunError where a state is not
/// finite.
CellMeasures measure_cell(const Simulation &simulation, const CellLoading &loading);

} // namespace bergamo::dem
