#pragma once

#include "dem/measure/coordination.h"
#include "dem/measure/fabric.h"
#include "dem/measure/force_statistics.h"
#include "dem/measure/stress.h"

#include <cstdint>
#include <span>

namespace bergamo::dem
{

/// What the contacts of an assembly say of it at one step: a row of a history. Walls count for the coordination numbers
/// and the stress alone.
struct AssemblyMeasures
{
  std::int64_t n_contacts = 0; ///< between grains
  CoordinationNumbers coordination;
  Mat3 fabric = Mat3::Zero();    ///< see fabric_tensor()
  double sliding_fraction = 0.;  ///< at Coulomb's limit
  double mean_normal_force = 0.; ///< [N]
  Mat3 stress = Mat3::Zero();    ///< mean, tension positive [Pa]
};

/// @param pairs touching contacts between grains; @param walls with walls, none in a periodic cell
/// @param friction Coulomb's coefficient between grains; @param volume of the assembly [m^3]
/// @throws ConfigError if the volume is not positive
AssemblyMeasures measure_assembly(const Particles &particles, std::span<const TouchingContact> pairs,
                                  std::span<const TouchingContact> walls, double friction, double volume);

} // namespace bergamo::dem
