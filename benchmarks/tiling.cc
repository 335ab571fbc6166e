#include "benchmarks/tiling.h"

#include "dem/loading/compression.h"

namespace bergamo::benchmark
{

std::unique_ptr<dem::Simulation> tile(const dem::Simulation &packing, const std::array<int, 3> &n)
{
  const dem::Particles &cell = packing.particles;
  const dem::Box box = dem::box_between(packing.walls);
  const Vec3 edges = box.edges();
  dem::Particles particles;
  for (int x = 0; x < n[0]; ++x)
    for (int y = 0; y < n[1]; ++y)
      for (int z = 0; z < n[2]; ++z)
        for (std::size_t i = 0; i < cell.size(); ++i)
          particles.add(cell.parts.shape[i], packing.parameters().grain().density,
                        cell.position[i] + Vec3(x, y, z).cwiseProduct(edges), cell.orientation[i]);
  return std::make_unique<dem::Simulation>(
      packing.parameters(), std::move(particles),
      dem::box_walls({box.low, box.low + Vec3(n[0], n[1], n[2]).cwiseProduct(edges)}));
}

} // namespace bergamo::benchmark
