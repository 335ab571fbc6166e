#include "dem/neighbour/row_search.h"

#include "dem/core/pack.h"

namespace bergamo::dem
{
namespace
{

/// Of the image of a partner against itself in one direction (PeriodicCell::nearest_image). @param line to the partner
BERGAMO_INLINE Pack shift_of_nearest(const Pack &line, const double edge)
{
  return math::select(line > Pack(0.5 * edge), Pack(-edge),
                      math::select(line < Pack(-0.5 * edge), Pack(edge), Pack(0.)));
}

/// Index in [begin, end) of the first value that is not less than a limit.
std::int32_t first_from(const std::vector<double> &values, const std::int32_t begin, const std::int32_t end,
                        const double limit)
{
  return static_cast<std::int32_t>(std::lower_bound(values.begin() + begin, values.begin() + end, limit) -
                                   values.begin());
}

} // namespace

RowSearch::RowSearch(const SphereRows &rows, const double verlet_distance, const PeriodicCell &cell,
                     const std::span<const std::uint8_t> sought)
    : rows(rows), verlet_distance(verlet_distance), cell(cell), sought(sought), rounding(1e-12 * cell.period.maxCoeff())
{
}

double RowSearch::reach_to(const SphereClass &other) const
{
  return 0.5 * (size->range + other.range) * (1. + 1e-12) + rounding;
}

void RowSearch::go_to_layer(const SphereClass &new_size, const std::int32_t begin, const std::int32_t end)
{
  size = &new_size;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (std::int32_t s = begin; s < end; ++s)
  {
    const double z = place_in(cell, {0., 0., rows.spheres.z[s]})[2];
    low = std::min(low, z);
    high = std::max(high, z);
  }
  near_layers.clear();
  for (auto k = size - rows.classes.data(); k >= 0; --k) // its own first, then the larger ones
  {
    const SphereClass *const other = &rows.classes[k];
    const double reach = reach_to(*other);
    const RowNumbers numbers(*other, 2, {low - reach, high + reach});
    for (int stretch = 0; stretch < numbers.n_stretches; ++stretch)
    {
      const auto [first, last] = numbers.stretch[stretch];
      const auto end_layers = rows.layers.begin() + other->end_layers;
      for (auto layer = std::partition_point(rows.layers.begin() + other->begin_layers, end_layers,
                                             [&, first = first](const SphereLayer &l) { return l.number < first; });
           layer != end_layers && layer->number <= last; ++layer)
        near_layers.push_back({other, layer->begin_rows, layer->end_rows, layer->begin_rows});
    }
  }
}

std::pair<std::int32_t, std::int32_t> RowSearch::of_interest(std::int32_t begin, std::int32_t end) const
{
  if (size != rows.classes.data()) // larger ones may be sought
    return {begin, end};
  while (begin < end && !is_sought(begin))
    ++begin;
  while (begin < end && !is_sought(end - 1))
    --end;
  return {begin, end};
}

template <class Visit>
void RowSearch::for_each_near_row(NearLayer &layer, const RowNumbers &numbers, Visit &&visit)
{
  for (int k = 0; k < numbers.n_stretches; ++k)
  {
    // One row after another is gone to: the first one in reach is mostly the last one's or one of the next.
    const auto is_before = [&](const SphereRow &row) { return row.number < numbers.stretch[k].low; };
    std::int32_t row = layer.next_row;
    if (row > layer.begin_rows && !is_before(rows.rows[row - 1]))
      row = layer.begin_rows;
    for (int tries = 0; tries < 4 && row < layer.end_rows && is_before(rows.rows[row]); ++tries)
      ++row;
    if (row < layer.end_rows && is_before(rows.rows[row]))
      row = static_cast<std::int32_t>(
          std::partition_point(rows.rows.begin() + row, rows.rows.begin() + layer.end_rows, is_before) -
          rows.rows.begin());
    layer.next_row = row;
    for (; row < layer.end_rows && rows.rows[row].number <= numbers.stretch[k].high; ++row)
      visit(rows.rows[row]);
  }
}

std::pair<Vec3, Vec3> RowSearch::bounds(const std::int32_t begin, const std::int32_t end) const
{
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (std::int32_t s = begin; s < end; ++s)
  {
    const Vec3 x = place_in(cell, {rows.spheres.x[s], rows.spheres.y[s], rows.spheres.z[s]});
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  return {low, high};
}

void RowSearch::go_to_row(const std::int32_t begin, const std::int32_t end)
{
  const auto [low, high] = bounds(begin, end);
  const double first_place = low[0];
  near_rows.clear();
  larger_rows.clear();
  for (auto layer = near_layers.begin(); layer != near_layers.end();)
  {
    const SphereClass *const other = layer->size;
    const double reach = reach_to(*other);
    const RowNumbers numbers(*other, 1, {low[1] - reach, high[1] + reach});
    for (; layer != near_layers.end() && layer->size == other; ++layer)
      for_each_near_row(
          *layer, numbers,
          [&](const SphereRow &row)
          {
            if (other == size)
              near_rows.push_back(
                  {row.begin, row.end, first_from(rows.spheres.place, row.begin, row.end, first_place - reach)});
            else
              larger_rows.push_back({row.begin, row.end, reach});
          });
  }
}

void RowSearch::gather_larger(const std::int32_t begin, const std::int32_t end)
{
  n_larger = n_larger_sought = 0;
  if (larger_rows.empty())
    return;
  bool any_is_sought = false;
  for (std::int32_t s = begin; s < end; ++s)
    any_is_sought = any_is_sought || is_sought(s);
  const auto [low, high] = bounds(begin, end);
  const Vec3 centre = 0.5 * low + 0.5 * high, half = 0.5 * high - 0.5 * low;
  const SphereArrays &all = rows.spheres;
  const auto is_in_reach = [&](const double place, const int d, const double reach)
  {
    double line = place - centre[d];
    if (cell.is_periodic(d))
      line -= cell.edges[d] * std::round(line / cell.edges[d]);
    return std::abs(line) <= half[d] * (1. + 1e-12) + reach;
  };
  const auto gather = [&](const LargerRow &row, const double low_place, const double high_place)
  {
    for (std::int32_t s = first_from(all.place, row.begin, row.end, low_place);
         s < row.end && all.place[s] <= high_place; ++s)
    {
      const bool s_is_sought = is_sought(s);
      if (!(s_is_sought || any_is_sought) || !is_in_reach(all.y[s], 1, row.reach) ||
          !is_in_reach(all.z[s], 2, row.reach))
        continue;
      if (larger.sphere.size() < static_cast<std::size_t>(n_larger + 1 + pack_width))
        larger.resize(2 * n_larger + 1);
      if (s_is_sought)
        larger.put(n_larger, larger, n_larger_sought);
      larger.put(s_is_sought ? n_larger_sought++ : n_larger, all, s);
      ++n_larger;
    }
  };
  const double length = cell.edges[0];
  for (const LargerRow &row : larger_rows)
  {
    const double from = low[0] - row.reach, to = high[0] + row.reach;
    if (to - from >= length - rounding) // all around a periodic cell
      gather(row, 0., length);
    else
    {
      gather(row, from, to);
      if (from < 0. && cell.is_periodic(0))
        gather(row, from + length, length);
      if (to > length)
        gather(row, 0., to - length);
    }
  }
}

template <bool is_periodic>
void RowSearch::look_into(const Stretch &others, const std::int32_t of)
{
  const SphereArrays &own = rows.spheres, &other = *others.spheres;
  const Pack lanes([](auto lane) { return static_cast<double>(lane); });
  for (std::int32_t k = others.begin; k < others.end && other.place[k] <= others.last_place; k += pack_width)
  {
    Pack x = math::load(&other.x[k]) - Pack(own.x[of]);
    Pack y = math::load(&other.y[k]) - Pack(own.y[of]);
    Pack z = math::load(&other.z[k]) - Pack(own.z[of]);
    if constexpr (is_periodic)
    {
      x += shift_of_nearest(x, cell.edges[0]);
      y += shift_of_nearest(y, cell.edges[1]);
      z += shift_of_nearest(z, cell.edges[2]);
    }
    const Pack range = Pack(own.radius[of]) + math::load(&other.radius[k]) + Pack(verlet_distance);
    auto is_near = x * x + y * y + z * z < range * range && lanes < Pack(static_cast<double>(others.end - k));
    if constexpr (is_periodic) // what lies further on may be near by another image, and is looked at there
      is_near = is_near && math::load(&other.place[k]) <= Pack(others.last_place);
    if (!math::any(is_near))
      continue;
    if (found.size() < n_found + pack_width)
      found.resize(2 * found.size() + pack_width);
    for (int l = 0; l < pack_width; ++l)
    {
      const std::int32_t partner = other.sphere[k + l];
      found[n_found] = partner;
      n_found += math::lane(is_near, l) & (partner > others.least || !(sought.empty() || sought[partner]));
    }
  }
}

void RowSearch::find_partners(const std::int32_t of)
{
  const SphereArrays &all = rows.spheres;
  const double place = all.place[of], reach = reach_to(*size);
  const bool is_periodic = cell.is_periodic();
  n_found = 0;
  const bool of_is_sought = is_sought(of);
  for (NearRow &row : near_rows)
  {
    if (!of_is_sought)
      break;
    const Pack least(place - reach);
    for (int passed = pack_width; passed == pack_width && row.next < row.end; row.next += passed)
      passed = math::first_true(math::load(&all.place[row.next]) >= least);
    row.next = std::min(row.next, row.end);
    if (is_periodic)
      look_around(row, of);
    else
      look_into<false>({&all, row.next, row.end, place + reach, all.sphere[of]}, of);
  }
  const std::int32_t n = of_is_sought ? n_larger : n_larger_sought;
  const Stretch all_larger{&larger, 0, n, std::numeric_limits<double>::infinity(), -1};
  if (is_periodic)
    look_into<true>(all_larger, of);
  else
    look_into<false>(all_larger, of);
}

void RowSearch::look_around(const NearRow &row, const std::int32_t of)
{
  const SphereArrays &all = rows.spheres;
  const double place = all.place[of], reach = reach_to(*size), low = place - reach, high = place + reach;
  const std::int32_t own = all.sphere[of];
  look_into<true>({&all, row.next, row.end, high, own}, of);
  if (!cell.is_periodic(0))
    return;
  // What is left beyond each face of the cell: no sphere twice where both meet on the other side.
  const double length = cell.edges[0];
  if (high > length)
    look_into<true>({&all, row.begin, row.next, high - length, own}, of);
  if (low < 0.)
  {
    const auto after = std::upper_bound(all.place.begin() + row.next, all.place.begin() + row.end, high);
    const auto begin = static_cast<std::int32_t>(after - all.place.begin());
    look_into<true>({&all, first_from(all.place, begin, row.end, low + length), row.end, length, own}, of);
  }
}

} // namespace bergamo::dem
