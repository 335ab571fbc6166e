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

/// Index in [begin, end) of the first value that is not less than a limit.
std::int32_t first_from(const std::vector<double> &values, const std::int32_t begin, const std::int32_t end,
                        const double limit)
{
  return static_cast<std::int32_t>(std::lower_bound(values.begin() + begin, values.begin() + end, limit) -
                                   values.begin());
}

} // namespace

RowSearch::RowSearch(const SphereRows &rows, const double verlet_distance, const PeriodicCell &cell)
    : rows(rows), verlet_distance(verlet_distance), cell(cell),
      rounding(cell.is_periodic() ? 1e-12 * cell.edges.maxCoeff() : 0.), in_order(rows.classes.size())
{
}

double RowSearch::reach_to(const SizeClass &other) const
{
  return 0.5 * (size->range + other.range) * (1. + 1e-12) + rounding;
}

void RowSearch::go_to_layer(const SizeClass &new_size, const std::int32_t begin, const std::int32_t end)
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
  for (const SizeClass *other = size; other >= rows.classes.data(); --other) // its own first, then the larger ones
  {
    const double reach = reach_to(*other);
    const RowNumbers numbers(*other, 2, {low - reach, high + reach});
    for (int k = 0; k < numbers.n_stretches; ++k)
    {
      const auto end_layers = rows.layers.begin() + other->end_layers;
      for (auto layer = std::partition_point(rows.layers.begin() + other->begin_layers, end_layers,
                                             [&](const SphereLayer &l) { return l.number < numbers.stretch[k].low; });
           layer != end_layers && layer->number <= numbers.stretch[k].high; ++layer)
        near_layers.push_back({other, layer->begin_rows, layer->end_rows, layer->begin_rows});
    }
  }
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

void RowSearch::go_to_row(const std::int32_t begin, const std::int32_t end)
{
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (std::int32_t s = begin; s < end; ++s)
  {
    const Vec3 x = place_in(cell, {rows.spheres.x[s], rows.spheres.y[s], rows.spheres.z[s]});
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  candidates.clear();
  for (auto layer = near_layers.begin(); layer != near_layers.end();)
  {
    const SizeClass *const other = layer->size;
    const double reach = reach_to(*other);
    const RowNumbers numbers(*other, 1, {low[1] - reach, high[1] + reach});
    larger.clear();
    for (; layer != near_layers.end() && layer->size == other; ++layer)
      for_each_near_row(*layer, numbers,
                        [&](const SphereRow &row)
                        {
                          if (other == size)
                            candidates.push_back({&rows.spheres, reach, row.begin, row.end,
                                                  first_from(rows.spheres.place, row.begin, row.end, low[0] - reach),
                                                  true});
                          else
                            gather(row, reach, low, high);
                        });
    if (larger.empty())
      continue;
    SphereArrays &spheres = in_order[other - rows.classes.data()];
    put_in_order(spheres);
    candidates.push_back({&spheres, reach, 0, static_cast<std::int32_t>(larger.size()), 0, false});
  }
}

void RowSearch::gather(const SphereRow &row, const double reach, const Vec3 &low, const Vec3 &high)
{
  const SphereArrays &all = rows.spheres;
  const Vec3 centre = 0.5 * low + 0.5 * high, half = 0.5 * high - 0.5 * low;
  const auto is_beside = [&](const double place, const int d)
  {
    double line = place - centre[d];
    if (cell.is_periodic())
      line -= cell.edges[d] * std::round(line / cell.edges[d]);
    return std::abs(line) > half[d] * (1. + 1e-12) + reach;
  };
  for (int image = cell.is_periodic() ? -1 : 0; image <= (cell.is_periodic() ? 1 : 0); ++image)
  {
    const double shift = image == 0 ? 0. : image * cell.edges[0];
    for (std::int32_t s = first_from(all.place, row.begin, row.end, low[0] - reach - shift);
         s < row.end && all.place[s] <= high[0] + reach - shift; ++s)
      if (!is_beside(all.y[s], 1) && !is_beside(all.z[s], 2))
        larger.push_back({all.place[s] + shift, s});
  }
}

void RowSearch::put_in_order(SphereArrays &spheres)
{
  std::sort(larger.begin(), larger.end(),
            [](const Larger &a, const Larger &b)
            { return a.place != b.place ? a.place < b.place : a.sphere < b.sphere; });
  const SphereArrays &all = rows.spheres;
  spheres.resize(larger.size());
  for (std::size_t k = 0; k < larger.size(); ++k)
  {
    const std::int32_t s = larger[k].sphere;
    spheres.sphere[k] = all.sphere[s];
    spheres.place[k] = larger[k].place;
    spheres.x[k] = all.x[s];
    spheres.y[k] = all.y[s];
    spheres.z[k] = all.z[s];
    spheres.radius[k] = all.radius[s];
  }
}

template <bool is_periodic>
void RowSearch::look_into(const Candidates &among, const std::int32_t of, const std::int32_t begin,
                          const std::int32_t end, const double last_place)
{
  const SphereArrays &own = rows.spheres, &other = *among.spheres;
  const std::int32_t least = among.is_own_class ? own.sphere[of] : -1;
  const Pack lanes([](auto lane) { return static_cast<double>(lane); });
  for (std::int32_t k = begin; k < end && other.place[k] <= last_place; k += pack_width)
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
    auto is_near = x * x + y * y + z * z < range * range && lanes < Pack(static_cast<double>(end - k));
    if constexpr (is_periodic) // what lies further on may be near by another image, and is looked at there
      is_near = is_near && math::load(&other.place[k]) <= Pack(last_place);
    if (!math::any(is_near))
      continue;
    if (found.size() < n_found + pack_width)
      found.resize(2 * found.size() + pack_width);
    for (int l = 0; l < pack_width; ++l)
    {
      const std::int32_t partner = other.sphere[k + l];
      found[n_found] = partner;
      n_found += math::lane(is_near, l) & (partner > least);
    }
  }
}

void RowSearch::find_partners(const std::int32_t of)
{
  const double place = rows.spheres.place[of];
  n_found = 0;
  for (Candidates &among : candidates)
  {
    const Pack least(place - among.reach);
    for (int passed = pack_width; passed == pack_width && among.next < among.end; among.next += passed)
      passed = math::first_true(math::load(&among.spheres->place[among.next]) >= least);
    among.next = std::min(among.next, among.end);
    if (cell.is_periodic())
      look_around(among, of);
    else
      look_into<false>(among, of, among.next, among.end, place + among.reach);
  }
}

void RowSearch::look_around(const Candidates &among, const std::int32_t of)
{
  const std::vector<double> &places = among.spheres->place;
  const double place = rows.spheres.place[of], low = place - among.reach, high = place + among.reach;
  look_into<true>(among, of, among.next, among.end, high);
  if (!among.is_own_class) // those have their images among them
    return;
  // What is left beyond each face of the cell: no sphere twice where both meet on the other side.
  const double length = cell.edges[0];
  if (high > length)
    look_into<true>(among, of, among.begin, among.next, high - length);
  if (low < 0.)
  {
    const auto after = std::upper_bound(places.begin() + among.next, places.begin() + among.end, high);
    const auto begin = static_cast<std::int32_t>(after - places.begin());
    look_into<true>(among, of, first_from(places, begin, among.end, low + length), among.end, length);
  }
}

} // namespace bergamo::dem
