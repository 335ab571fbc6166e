#pragma once

#include "dem/simulation/simulation.h"
#include "drivers/common/grading_parameters.h"

namespace bergamo::driver
{

/// The grains of a run, drawn as the run will draw them, and how fast some of them move in a packing.
class GrainTrial
{
public:
  /// @param solid_volume of the run's grains [m^3]; @param seed of the packing
  GrainTrial(const GradingParameters &sizes, double solid_volume, std::uint64_t seed);

  double n_grains() const { return static_cast<double>(drawn.size()); }
  const dem::Particles &grains() const { return drawn; } ///< of unit density, all at the origin

  /// Seconds of the wall clock that a step takes with all of the run's grains, from a dense periodic packing of at most
  /// 4000 of them at rest. Counts its contacts and estimates its stable step, too. @param parameters of the run's
  /// grains
  double seconds_of_step(const dem::SimulationParameters &parameters);

  /// @name Once a packing was tried
  /// @{
  double n_contacts() const { return contacts_per_grain * n_grains(); } ///< between grains

  /// By Hertz's law: contacts are as stiff as the cube root of the pressure on a packing [Pa]. @return [s]
  double stable_step(double pressure) const;
  /// @}

private:
  dem::Particles packing(double density) const;

  GradingParameters sizes;
  dem::Particles drawn;
  double contacts_per_grain = 0, tried_pressure = 0, tried_stable_step = 0;
};

} // namespace bergamo::driver
