#include "dem/packing/clump_grading.h"

#include "dem/packing/draw_until.h"

#include <algorithm>
#include <cmath>
#include <variant>

namespace bergamo::dem
{

Clump draw_clump(const ClumpGrading &grading, std::mt19937_64 &generator)
{
  const Superquadric grain = std::visit([&](const auto &sizes) { return draw_grain(sizes, generator); }, grading.sizes);
  const bool is_sieved = std::holds_alternative<SieveCurve>(grading.sizes);
  return grading.unit.scaled(is_sieved ? sieve_size(grain) / sieve_size(grading.unit)
                                       : std::cbrt(volume(grain) / grading.unit.volume()));
}

std::vector<Clump> draw_clumps(const ClumpGrading &grading, const double solid_volume, std::mt19937_64 &generator)
{
  std::visit([](const auto &sizes) { sizes.validate(); }, grading.sizes);
  return draw_until(solid_volume, [&] { return draw_clump(grading, generator); });
}

double sieve_size(const Clump &clump)
{
  Vec3 widths;
  for (int d = 0; d < 3; ++d)
    widths[d] = caliper_width(clump, Vec3::Unit(d));
  std::sort(widths.begin(), widths.end());
  return widths[1];
}

} // namespace bergamo::dem
