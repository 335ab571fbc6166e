#include "drivers/fit_mohr_coulomb/mean_curve.h"

#include <algorithm>
#include <limits>

namespace bergamo::driver
{

namespace
{

/// Rows with ever larger compression.
std::vector<std::size_t> advancing_rows(const TriaxialCurve &curve)
{
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < curve.size(); ++i)
    if (rows.empty() || curve.compression(i) > curve.compression(rows.back()))
      rows.push_back(i);
  return rows;
}

/// Between which rows a compression lies, and how far from the first to the second; at the rim, the nearest row.
struct Place
{
  std::size_t row, next;
  double share;

  double interpolate(const std::vector<double> &values) const
  {
    return values[row] + share * (values[next] - values[row]);
  }
};

Place place_of(const double compression, const TriaxialCurve &curve, const std::vector<std::size_t> &rows)
{
  const auto above =
      std::lower_bound(rows.begin(), rows.end(), compression,
                       [&](const std::size_t row, const double c) { return curve.compression(row) < c; });
  if (above == rows.begin())
    return {rows.front(), rows.front(), 0};
  if (above == rows.end())
    return {rows.back(), rows.back(), 0};
  const std::size_t row = *(above - 1), next = *above;
  return {row, next, (compression - curve.compression(row)) / (curve.compression(next) - curve.compression(row))};
}

} // namespace

std::vector<MeanPoint> mean_curve(const std::span<const TriaxialCurve *const> curves, const std::size_t n_points)
{
  std::vector<std::vector<std::size_t>> rows;
  double end = std::numeric_limits<double>::infinity();
  for (const TriaxialCurve *curve : curves)
  {
    rows.push_back(advancing_rows(*curve));
    end = std::min(end, curve->compression(rows.back().back()));
  }
  std::vector<MeanPoint> points;
  for (std::size_t i = 0; i < n_points; ++i)
  {
    const double share = static_cast<double>(i) / static_cast<double>(n_points - 1);
    const double compression = end * share * share;
    std::vector<double> axial, ratio, volumetric, solid_fraction;
    for (std::size_t k = 0; k < curves.size(); ++k)
    {
      const Place place = place_of(compression, *curves[k], rows[k]);
      axial.push_back(place.interpolate(curves[k]->axial_stress));
      ratio.push_back(axial.back() / place.interpolate(curves[k]->lateral_stress));
      volumetric.push_back(place.interpolate(curves[k]->volumetric_strain));
      solid_fraction.push_back(place.interpolate(curves[k]->solid_fraction));
    }
    points.push_back({-compression, statistic_of(axial), statistic_of(ratio), statistic_of(volumetric),
                      statistic_of(solid_fraction)});
  }
  return points;
}

} // namespace bergamo::driver
