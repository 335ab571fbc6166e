#include "dem/measure/assembly_measures.h"

namespace bergamo::dem
{

AssemblyMeasures measure_assembly(const Particles &particles, const std::span<const TouchingContact> pairs,
                                  const std::span<const TouchingContact> walls, const double friction,
                                  const double volume)
{
  return {static_cast<std::int64_t>(pairs.size()),
          coordination_numbers(particles, pairs, walls),
          fabric_tensor(pairs),
          sliding_fraction(pairs, friction),
          mean_normal_force(pairs),
          mean_stress(pairs, volume) + mean_stress(walls, volume)};
}

} // namespace bergamo::dem
