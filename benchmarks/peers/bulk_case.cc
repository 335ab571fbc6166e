#include "benchmarks/peers/bulk_case.h"

#include "dem/law/restitution.h"

#include <numeric>
#include <random>

namespace bergamo::benchmark
{

dem::SimulationParameters bulk_parameters(const double softening)
{
  constexpr double poisson_ratio = 0.2;
  dem::SimulationParameters p;
  p.materials = dem::MaterialTable({{1e9 / softening, poisson_ratio, 2500.},
                                    {210e9, poisson_ratio, 7200.},
                                    {0.5e9 / softening, poisson_ratio, 2000.}});
  const auto pair = [&](const std::int32_t first, const std::int32_t second, const double friction, const double e) {
    p.materials.between(first, second) = {friction, dem::damping_ratio_of(e), 0.};
  };
  pair(material_1, material_1, 0.3, 0.5);
  pair(material_2, material_2, 0.4, 0.4);
  pair(material_1, material_2, 0.2, 0.45);
  pair(material_1, steel, 0.2, 0.4);
  pair(material_2, steel, 0.2, 0.4);
  pair(steel, steel, 0.2, 0.4); // not given, and no case has such a contact
  p.gravity = Vec3(0., 0., -9.81);
  return p;
}

double mean_radius(const BulkCase &bulk)
{
  const std::vector<double> &radius = bulk.beads.bounding_radius;
  return std::accumulate(radius.begin(), radius.end(), 0.) / static_cast<double>(radius.size());
}

Vec3 spin_of(const dem::Particles &beads, const std::size_t i)
{
  return beads.angular_momentum[i] / beads.inertia[i].x();
}

BulkCase perturbed(BulkCase bulk, const std::uint64_t seed)
{
  constexpr double largest = 1e-9; // [m]
  std::mt19937_64 generator(seed);
  std::uniform_real_distribution<double> shift(-largest, largest);
  for (Vec3 &x : bulk.beads.position)
    x += Vec3(shift(generator), shift(generator), shift(generator));
  return bulk;
}

} // namespace bergamo::benchmark
