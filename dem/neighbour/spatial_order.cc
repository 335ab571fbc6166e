#include "dem/neighbour/spatial_order.h"

#include "dem/core/parallel_sort.h"

#include <algorithm>
#include <array>
#include <tuple>

namespace bergamo::dem
{
namespace
{

constexpr int bits = 21; // of a cell's number in each direction: three make up an index of 63 bits
constexpr double n_cells = 1 << bits;

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

/// Where the cells of a direction begin: at the least place, or, if they do not reach from there to the greatest one,
/// so that the middle grain lies in the middle of them. Some grains that have left then take no cells from the others.
double origin(const std::span<const Vec3> positions, const int direction, const double cell_size)
{
  std::vector<double> x;
  for (const Vec3 &position : positions)
    x.push_back(position[direction]);
  const auto [least, most] = std::minmax_element(x.begin(), x.end());
  const double low = *least, reach = n_cells * cell_size;
  if (*most - low < reach)
    return low;
  const auto middle = x.begin() + x.size() / 2;
  std::nth_element(x.begin(), middle, x.end());
  return std::max(low, *middle - 0.5 * reach);
}

struct Entry
{
  std::uint64_t index; // along the curve
  Vec3 position;
  std::int32_t grain;

  bool is_before(const Entry &other) const
  {
    return std::tie(index, position[0], position[1], position[2], grain) <
           std::tie(other.index, other.position[0], other.position[1], other.position[2], other.grain);
  }
};

} // namespace

std::vector<std::int32_t> spatial_order(const std::span<const Vec3> positions, const double cell_size)
{
  const std::size_t n = positions.size();
  if (n == 0)
    return {};
  const Vec3 low(origin(positions, 0, cell_size), origin(positions, 1, cell_size), origin(positions, 2, cell_size));
  std::vector<Entry> entries(n);
  parallel_for(n,
               [&](const std::size_t i)
               {
                 std::array<std::uint32_t, 3> cell;
                 for (int d = 0; d < 3; ++d)
                   cell[d] =
                       static_cast<std::uint32_t>(std::clamp((positions[i][d] - low[d]) / cell_size, 0., n_cells - 1.));
                 entries[i] = {hilbert_index(cell), positions[i], static_cast<std::int32_t>(i)};
               });
  parallel_sort(entries, [](const Entry &a, const Entry &b) { return a.is_before(b); });
  std::vector<std::int32_t> order(n);
  parallel_for(n, [&](const std::size_t k) { order[k] = entries[k].grain; });
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
