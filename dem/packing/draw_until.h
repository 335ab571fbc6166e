#pragma once

#include "dem/core/error.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace bergamo::dem
{

/// Grains from draw() until their volume reaches solid_volume [m^3] as nearly as whole grains can, one at least. Throws
/// ConfigError for a volume that is not positive, or that takes more grains than can be numbered.
template <class Draw>
auto draw_until(const double solid_volume, const Draw &draw)
{
  constexpr std::size_t largest_number = std::numeric_limits<std::int32_t>::max();
  constexpr std::size_t enough_to_tell = 1000; // how many it will be, long before the memory is full
  require(solid_volume > 0. && std::isfinite(solid_volume), "solid volume of the grains", solid_volume,
          "positive and finite [m^3]");
  std::vector<decltype(draw())> grains;
  double sum = 0.;
  while (true)
  {
    auto grain = draw();
    const double v = volume(grain);
    if (sum + 0.5 * v > solid_volume && !grains.empty())
      return grains;
    sum += v;
    grains.push_back(std::move(grain));
    const double expected = std::round(solid_volume / sum * static_cast<double>(grains.size()));
    require(grains.size() < largest_number && (grains.size() != enough_to_tell || expected < largest_number),
            "number of grains of the solid volume", expected, "below 2^31; take larger grains or a smaller space");
  }
}

} // namespace bergamo::dem
