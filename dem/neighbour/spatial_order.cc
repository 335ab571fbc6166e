#include "dem/neighbour/spatial_order.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

namespace bergamo::dem
{
namespace
{

constexpr int bits = 21; // of a cell's number in each direction: three make up an index of 63 bits

/// Number of a cell along Hilbert's curve through 2^bits cells in each direction (Skilling 2004, "Programming the
/// Hilbert curve").
std::uint64_t hilbert_index(std::array<std::uint32_t, 3> x)
{
  constexpr std::uint32_t top = 1u << (bits - 1);
  for (std::uint32_t bit = top; bit > 1; bit >>= 1)
    for (std::uint32_t &number : x)
    {
      const std::uint32_t below = bit - 1;
      if (number & bit)
      {
        x[0] ^= below;
        continue;
      }
      const std::uint32_t exchanged = (x[0] ^ number) & below;
      x[0] ^= exchanged;
      number ^= exchanged;
    }
  x[1] ^= x[0];
  x[2] ^= x[1];
  std::uint32_t gray = 0;
  for (std::uint32_t bit = top; bit > 1; bit >>= 1)
    if (x[2] & bit)
      gray ^= bit - 1;
  std::uint64_t index = 0;
  for (int bit = bits - 1; bit >= 0; --bit)
    for (const std::uint32_t number : x)
      index = index << 1 | ((number ^ gray) >> bit & 1u);
  return index;
}

} // namespace

std::vector<std::int32_t> spatial_order(const std::span<const Vec3> positions, const double cell_size)
{
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::max());
  for (const Vec3 &x : positions)
    low = low.cwiseMin(x);
  std::vector<std::uint64_t> index;
  for (const Vec3 &x : positions)
  {
    std::array<std::uint32_t, 3> cell;
    for (int d = 0; d < 3; ++d)
      cell[d] = static_cast<std::uint32_t>(std::min((x[d] - low[d]) / cell_size, std::ldexp(1., bits) - 1.));
    index.push_back(hilbert_index(cell));
  }
  const auto comes_first = [&](const std::int32_t i, const std::int32_t j)
  {
    if (index[i] != index[j])
      return index[i] < index[j];
    for (int d = 0; d < 3; ++d)
      if (positions[i][d] != positions[j][d])
        return positions[i][d] < positions[j][d];
    return i < j;
  };
  std::vector<std::int32_t> order(positions.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), comes_first);
  return order;
}

std::vector<std::int32_t> inverse_order(const std::span<const std::int32_t> order)
{
  std::vector<std::int32_t> new_index(order.size());
  for (std::size_t i = 0; i < order.size(); ++i)
    new_index[order[i]] = static_cast<std::int32_t>(i);
  return new_index;
}

} // namespace bergamo::dem
