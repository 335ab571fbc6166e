#include "dem/measure/mixing.h"

#include "dem/core/error.h"

#include <array>
#include <cassert>
#include <cmath>
#include <map>

namespace bergamo::dem
{

double lacey_index(const std::span<const Vec3> position, const std::span<const std::uint8_t> is_first,
                   const double cell)
{
  assert(position.size() == is_first.size());
  require(cell > 0., "edge of the cells in which mixing is measured", cell, "positive [m]");
  struct Count
  {
    double all = 0., first = 0.;
  };
  std::map<std::array<double, 3>, Count> cells; // their order is that of the sums, whatever that of the grains
  Count total;
  for (std::size_t i = 0; i < position.size(); ++i)
  {
    const Vec3 corner = (position[i] / cell).array().floor();
    for (Count *const count : {&cells[{corner.x(), corner.y(), corner.z()}], &total})
    {
      count->all += 1.;
      count->first += is_first[i] ? 1. : 0.;
    }
  }
  require(total.first > 0. && total.first < total.all, "number of grains of the first kind", total.first,
          "above 0 and below that of all grains");
  const auto n_cells = static_cast<double>(cells.size());
  require(n_cells < total.all, "number of cells with grains", n_cells, "below that of the grains; make cells larger");

  const double share = total.first / total.all;
  double variance = 0.;
  for (const auto &[corner, count] : cells)
    variance += count.all / total.all * std::pow(count.first / count.all - share, 2);
  const double apart = share * (1. - share), random = apart * (n_cells - 1.) / (total.all - 1.);
  return (apart - variance) / (apart - random);
}

} // namespace bergamo::dem
