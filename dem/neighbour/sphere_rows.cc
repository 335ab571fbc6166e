#include "dem/neighbour/sphere_rows.h"

#include "dem/core/pack.h"
#include "dem/core/parallel_sort.h"

#include <array>
#include <cmath>
#include <tuple>

namespace bergamo::dem
{
namespace
{

constexpr int most_classes = 24; // the last one has all that is smaller

struct Entry
{
  std::int32_t size_class, sphere;
  double z, y, place; // numbers of the row, and x

  bool is_before(const Entry &other) const
  {
    return std::tie(size_class, z, y, place, sphere) <
           std::tie(other.size_class, other.z, other.y, other.place, other.sphere);
  }
};

/// Greatest value(i) over [0, n), at least zero.
template <class Value>
double greatest(const std::size_t n, Value &&value)
{
  Collected<double> found;
  parallel_ranges(n, 1024,
                  [&](const std::size_t part, const std::size_t begin, const std::size_t end)
                  {
                    double most = 0.;
                    for (std::size_t i = begin; i < end; ++i)
                      most = std::max(most, value(i));
                    found.of(part).push_back(most);
                  });
  double most = 0.;
  found.for_each([&](const double of_part) { most = std::max(most, of_part); });
  return most;
}

double row_number(const SizeClass &size, const int d, const double place)
{
  return std::min(std::floor(place / size.width[d]), size.n_rows[d] - 1.);
}

} // namespace

void SphereArrays::resize(const std::size_t n_spheres)
{
  sphere.resize(n_spheres + pack_width);
  for (std::vector<double> *numbers : {&place, &x, &y, &z, &radius})
    numbers->resize(n_spheres + pack_width);
}

SphereRows::SphereRows(const BoundingSpheres &given, const double verlet_distance, const PeriodicCell &cell)
{
  const std::size_t n = given.positions.size();
  const auto range = [&](const std::size_t i) { return 2. * given.radii[i] + verlet_distance; };
  const double largest = greatest(n, range);
  const auto class_of = [&](const std::size_t i)
  { return range(i) > 0. ? std::min(std::ilogb(largest / range(i)), most_classes - 1) : most_classes - 1; };

  Collected<std::array<double, most_classes>> ranges;
  parallel_ranges(n, 1024,
                  [&](const std::size_t part, const std::size_t begin, const std::size_t end)
                  {
                    std::array<double, most_classes> most;
                    most.fill(-1.);
                    for (std::size_t i = begin; i < end; ++i)
                    {
                      double &of_class = most[class_of(i)];
                      of_class = std::max(of_class, range(i));
                    }
                    ranges.of(part).push_back(most);
                  });
  std::array<double, most_classes> most;
  most.fill(-1.);
  ranges.for_each(
      [&](const std::array<double, most_classes> &of_part)
      {
        for (int k = 0; k < most_classes; ++k)
          most[k] = std::max(most[k], of_part[k]);
      });
  std::array<std::int32_t, most_classes> used;
  for (int k = 0; k < most_classes; ++k)
    if (most[k] >= 0.)
    {
      used[k] = static_cast<std::int32_t>(classes.size());
      SizeClass size;
      size.range = most[k];
      size.width.setConstant(std::max(most[k], std::numeric_limits<double>::min()));
      size.n_rows = (cell.edges.array() / size.width.array()).floor().max(1.);
      if (cell.is_periodic())
        size.width = cell.edges.cwiseQuotient(size.n_rows);
      classes.push_back(size);
    }

  std::vector<Entry> entries(n);
  parallel_for(n,
               [&](const std::size_t i)
               {
                 const Vec3 x = place_in(cell, given.positions[i]);
                 const std::int32_t k = used[class_of(i)];
                 entries[i] = {k, static_cast<std::int32_t>(i), row_number(classes[k], 2, x[2]),
                               row_number(classes[k], 1, x[1]), x[0]};
               });
  parallel_sort(entries, [](const Entry &a, const Entry &b) { return a.is_before(b); });

  for (std::size_t s = 0; s < n; ++s)
  {
    const Entry &e = entries[s];
    SizeClass &size = classes[e.size_class];
    const bool is_new_class = s == 0 || e.size_class != entries[s - 1].size_class;
    const bool is_new_layer = is_new_class || e.z != layers.back().number;
    const auto n_rows = static_cast<std::int32_t>(rows.size());
    if (is_new_class)
      size.begin_layers = static_cast<std::int32_t>(layers.size());
    if (is_new_layer)
      layers.push_back({e.z, n_rows, n_rows});
    if (is_new_layer || e.y != rows.back().number)
      rows.push_back({e.y, static_cast<std::int32_t>(s), 0});
    rows.back().end = static_cast<std::int32_t>(s) + 1;
    layers.back().end_rows = static_cast<std::int32_t>(rows.size());
    size.end_layers = static_cast<std::int32_t>(layers.size());
  }

  spheres.resize(n);
  parallel_for(n,
               [&](const std::size_t s)
               {
                 const std::int32_t i = entries[s].sphere;
                 spheres.sphere[s] = i;
                 spheres.place[s] = entries[s].place;
                 spheres.x[s] = given.positions[i][0];
                 spheres.y[s] = given.positions[i][1];
                 spheres.z[s] = given.positions[i][2];
                 spheres.radius[s] = given.radii[i];
               });
}

Vec3 place_in(const PeriodicCell &cell, const Vec3 &x)
{
  return cell.is_periodic() ? Vec3(x - (x.array() / cell.edges.array()).floor().matrix().cwiseProduct(cell.edges)) : x;
}

RowNumbers::RowNumbers(const SizeClass &size, const int direction, const Interval &interval)
{
  const double n = size.n_rows[direction];
  const double first = std::floor(interval.low / size.width[direction]);
  const double last = std::floor(interval.high / size.width[direction]);
  if (n == std::numeric_limits<double>::infinity())
    stretch[0] = {first, last};
  else if (last - first + 1. >= n)
    stretch[0] = {0., n - 1.};
  else
  {
    stretch[0] = {first - n * std::floor(first / n), last - n * std::floor(last / n)};
    if (stretch[0].low > stretch[0].high)
    {
      n_stretches = 2;
      stretch[1] = {stretch[0].low, n - 1.};
      stretch[0].low = 0.;
    }
  }
}

} // namespace bergamo::dem
