#pragma once

#include "dem/packing/distribution.h"
#include "dem/packing/space.h"
#include "dem/simulation/simulation_parameters.h"
#include "drivers/common/parameter_file.h"
#include "drivers/common/run/step_count.h"

#include <cstdint>
#include <string>

namespace bergamo::driver
{

/// How sand in a rigid box is made: packed without contacts, or read from a file, and settled under a weight of its
/// own.
struct SandParameters
{
  Vec3 box{0.075, 0.02, 0.01425}; ///< inner edges; upright: of the loose packing [m]
  dem::GrainDistribution distribution;
  double solid_fraction = 0.5; ///< of the loose packing
  std::uint64_t seed = 1;
  std::string grains_file;         ///< instead of a packing of its own; empty: none
  double settling_gravity = 1000.; ///< [m/s²]
  double settling_time = 4e-3;     ///< [s]
  double settling_step = 2e-7;     ///< [s]
  double settling_damping = 0.9;   ///< share of critical damping

  /// Binds them to the section "Sand".
  void declare(ParameterFile &file);

  /// Throws ConfigError for values that do not go together, before any work.
  /// @param grain their mineral; @param place of the box [m]
  void validate(const dem::Material &grain, const dem::Box &place) const;

  /// Throws ConfigError for a step above that of two of the smallest grains in a contact as soft as no packing's.
  void require_stable(const NamedTime &step, const dem::Material &grain) const;

  /// While the sand settles. @param after settling
  dem::SimulationParameters settling(const dem::SimulationParameters &after) const;

  std::int64_t n_settling_steps() const;
};

} // namespace bergamo::driver
