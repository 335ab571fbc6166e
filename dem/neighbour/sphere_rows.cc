#include "dem/neighbour/sphere_rows.h"

#include "dem/core/pack.h"
#include "dem/core/parallel_sort.h"
#include "dem/neighbour/size_classes.h"

#include <cmath>
#include <tuple>

namespace bergamo::dem
{
namespace
{

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

double row_number(const SphereClass &size, const int d, const double place)
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
  const SizeClasses sizes = divide_by_size(given.radii, verlet_distance);
  for (const double range : sizes.range)
  {
    SphereClass size;
    size.range = range;
    size.width.setConstant(std::max(range, std::numeric_limits<double>::min()));
    size.n_rows = (cell.edges.array() / size.width.array()).floor().max(1.);
    for (int d = 0; d < 3; ++d)
      if (cell.is_periodic(d))
        size.width[d] = cell.edges[d] / size.n_rows[d];
    classes.push_back(size);
  }

  std::vector<Entry> entries(n);
  parallel_for(n,
               [&](const std::size_t i)
               {
                 const Vec3 x = place_in(cell, given.positions[i]);
                 const std::int32_t k = sizes.size_class[i];
                 entries[i] = {k, static_cast<std::int32_t>(i), row_number(classes[k], 2, x[2]),
                               row_number(classes[k], 1, x[1]), x[0]};
               });
  parallel_sort(entries, [](const Entry &a, const Entry &b) { return a.is_before(b); });

  for (std::size_t s = 0; s < n; ++s)
  {
    const Entry &e = entries[s];
    SphereClass &size = classes[e.size_class];
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
  return cell.is_periodic() ? Vec3(x - (x.array() / cell.edges.array()).floor().matrix().cwiseProduct(cell.period)) : x;
}

RowNumbers::RowNumbers(const SphereClass &size, const int direction, const Interval &interval)
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
