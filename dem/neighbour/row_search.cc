#include "dem/neighbour/row_search.h"

#include "dem/core/pack.h"

namespace bergamo::dem
{
namespace
{

/// Of the image of a partner against itself in one direction (PeriodicCell::nearest_image). @param line to the partner
Pack shift_of_nearest(const Pack &line, const double edge)
{
  return math::select(line > Pack(0.5 * edge), Pack(-edge),
                      math::select(line < Pack(-0.5 * edge), Pack(edge), Pack(0.)));
}

} // namespace

RowSearch::RowSearch(const SphereRows &rows, const double verlet_distance, const PeriodicCell &cell)
    : rows(rows), verlet_distance(verlet_distance), cell(cell)
{
}

void RowSearch::go_to(const SizeClass &size, const std::int32_t begin, const std::int32_t end)
{
  next = begin;
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (std::int32_t s = begin; s < end; ++s)
  {
    const Vec3 x = place_in(cell, {rows.x[s], rows.y[s], rows.z[s]});
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  // Wide enough for what rounding does to ranges, places in the cell and numbers of rows.
  const double rounding = cell.is_periodic() ? 1e-12 * cell.edges.maxCoeff() : 0.;
  near.clear();
  const auto gather = [&](const SizeClass &other)
  {
    const double reach = 0.5 * (size.range + other.range) * (1. + 1e-12) + rounding;
    const RowNumbers y(other, 1, {low[1] - reach, high[1] + reach}), z(other, 2, {low[2] - reach, high[2] + reach});
    for (int k = 0; k < z.n_stretches; ++k)
      for (int j = 0; j < y.n_stretches; ++j)
        for_each_row(rows, other, y.stretch[j], z.stretch[k],
                     [&](const SphereRow &row)
                     {
                       const auto from = rows.place.begin() + row.begin, to = rows.place.begin() + row.end;
                       const auto first = std::lower_bound(from, to, low[0] - reach) - rows.place.begin();
                       near.push_back({row.begin, row.end, static_cast<std::int32_t>(first), reach, &other == &size});
                     });
  };
  gather(size);
  for (const SizeClass &other : rows.classes)
    if (other.range > size.range)
      gather(other);
}

template <bool is_periodic>
void RowSearch::look_into(const NearRow &row, const std::int32_t begin, const std::int32_t end, const double last_place)
{
  const std::int32_t own = rows.sphere[next], least = row.is_own_class ? own : -1;
  const Pack lanes([](auto lane) { return static_cast<double>(lane); });
  for (std::int32_t k = begin; k < end && rows.place[k] <= last_place; k += pack_width)
  {
    Pack x = math::load(&rows.x[k]) - Pack(rows.x[next]);
    Pack y = math::load(&rows.y[k]) - Pack(rows.y[next]);
    Pack z = math::load(&rows.z[k]) - Pack(rows.z[next]);
    if constexpr (is_periodic)
    {
      x += shift_of_nearest(x, cell.edges[0]);
      y += shift_of_nearest(y, cell.edges[1]);
      z += shift_of_nearest(z, cell.edges[2]);
    }
    const Pack range = Pack(rows.radius[next]) + math::load(&rows.radius[k]) + Pack(verlet_distance);
    auto is_near = x * x + y * y + z * z < range * range && lanes < Pack(static_cast<double>(end - k));
    if constexpr (is_periodic) // what lies further on may be near by another image, and is looked at there
      is_near = is_near && math::load(&rows.place[k]) <= Pack(last_place);
    if (!math::any(is_near))
      continue;
    if (found.size() < n_found + pack_width)
      found.resize(2 * found.size() + pack_width);
    for (int l = 0; l < pack_width; ++l)
    {
      const std::int32_t partner = rows.sphere[k + l];
      found[n_found] = partner;
      n_found += math::lane(is_near, l) & (partner > least);
    }
  }
}

std::int32_t RowSearch::find_next()
{
  const double place = rows.place[next];
  n_found = 0;
  for (NearRow &row : near)
  {
    const Pack least(place - row.reach);
    for (int passed = pack_width; passed == pack_width && row.next < row.end; row.next += passed)
      passed = math::first_true(math::load(&rows.place[row.next]) >= least);
    row.next = std::min(row.next, row.end);
    if (cell.is_periodic())
      look_around(row, place);
    else
      look_into<false>(row, row.next, row.end, place + row.reach);
  }
  return rows.sphere[next++];
}

void RowSearch::look_around(const NearRow &row, const double place)
{
  // In the cell, then what is left beyond each of its faces: no sphere twice where they meet on the other side.
  const auto at = [&](const std::int32_t s) { return rows.place.begin() + s; };
  const double length = cell.edges[0], low = place - row.reach, high = place + row.reach;
  look_into<true>(row, row.next, row.end, high);
  if (high > length)
    look_into<true>(row, row.begin, row.next, high - length);
  if (low < 0.)
  {
    const auto begin = std::lower_bound(std::upper_bound(at(row.next), at(row.end), high), at(row.end), low + length);
    look_into<true>(row, static_cast<std::int32_t>(begin - rows.place.begin()), row.end, length);
  }
}

} // namespace bergamo::dem
