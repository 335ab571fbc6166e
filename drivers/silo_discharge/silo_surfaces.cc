#include "drivers/silo_discharge/silo_surfaces.h"

#include "dem/geometry/merge_nodes.h"

#include <cmath>
#include <cstdint>
#include <functional>

namespace bergamo::driver
{
namespace
{

/// Places between which the triangles of a rectangle lie, along each of its sides, ascending.
struct Lines
{
  std::vector<double> u, v; // [m]
};

/// Every interval between breaks in equal parts that are no longer than a size.
std::vector<double> refined(const std::vector<double> &breaks, const double size)
{
  std::vector<double> all{breaks.front()};
  for (std::size_t k = 1; k < breaks.size(); ++k)
  {
    const double begin = breaks[k - 1], length = breaks[k] - begin;
    const double n = std::ceil(length / size * (1. - 1e-9));
    for (int part = 1; part <= n; ++part)
      all.push_back(begin + length * part / n);
  }
  return all;
}

/// The cells between the lines whose middle is wanted, each of two triangles; seen from the grains u, v are
/// anticlockwise.
dem::Surface sheet(
    const Lines &lines, const std::function<Vec3(double, double)> &place,
    const std::function<bool(double, double)> &is_wanted = [](double, double) { return true; })
{
  std::vector<Vec3> nodes;
  for (const double v : lines.v)
    for (const double u : lines.u)
      nodes.push_back(place(u, v));
  std::vector<dem::Triangle> triangles;
  const auto n = static_cast<std::int32_t>(lines.u.size());
  for (std::size_t j = 0; j + 1 < lines.v.size(); ++j)
    for (std::size_t i = 0; i + 1 < lines.u.size(); ++i)
    {
      if (!is_wanted(0.5 * (lines.u[i] + lines.u[i + 1]), 0.5 * (lines.v[j] + lines.v[j + 1])))
        continue;
      const auto a = static_cast<std::int32_t>(i) + n * static_cast<std::int32_t>(j), b = a + 1, c = a + n, d = c + 1;
      triangles.insert(triangles.end(), {{a, b, c}, {b, d, c}});
    }
  constexpr double same_place = 1e-12; // m
  dem::merge_nodes(nodes, triangles, same_place);
  return {std::move(nodes), std::move(triangles)};
}

} // namespace

SiloSurfaces make_silo(const SiloShape &s)
{
  const double x = 0.5 * s.width, y = 0.5 * s.depth;
  std::vector<double> breaks{-x};
  for (auto w = s.orifice_widths.rbegin(); w != s.orifice_widths.rend(); ++w)
    breaks.push_back(-0.5 * *w);
  for (const double w : s.orifice_widths)
    breaks.push_back(0.5 * w);
  breaks.push_back(x);
  const std::vector<double> across = refined(breaks, s.triangle_size), along = refined({-y, y}, s.triangle_size),
                            up = refined({0., s.height}, s.triangle_size);
  const auto strip = [&](const double from, const double to)
  {
    return sheet(
        {across, along}, [](const double u, const double v) { return Vec3(u, v, 0.); },
        [from, to](const double u, double) { return std::abs(u) >= 0.5 * from && std::abs(u) < 0.5 * to; });
  };

  SiloSurfaces silo;
  const auto add = [&silo](const std::string &name, dem::Surface surface)
  {
    silo.names.push_back(name);
    silo.surfaces.push_back(std::move(surface));
  };
  add("left", sheet({along, up}, [x](const double u, const double v) { return Vec3(-x, u, v); }));
  add("right", sheet({up, along}, [x](const double u, const double v) { return Vec3(x, v, u); }));
  add("front", sheet({up, across}, [y](const double u, const double v) { return Vec3(v, -y, u); }));
  add("back", sheet({across, up}, [y](const double u, const double v) { return Vec3(u, y, v); }));
  add("floor", strip(s.orifice_widths.back(), s.width));
  silo.first_plug = silo.names.size();
  double narrower = 0.;
  for (std::size_t k = 0; k < s.orifice_widths.size(); ++k)
  {
    add("plug_" + std::to_string(k + 1), strip(narrower, s.orifice_widths[k]));
    narrower = s.orifice_widths[k];
  }
  return silo;
}

} // namespace bergamo::driver
