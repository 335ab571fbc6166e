#include "drivers/fit_mohr_coulomb/fit.h"

#include "dem/core/error.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace bergamo::driver
{

namespace
{

constexpr double degrees = 180 / std::numbers::pi;
constexpr std::size_t least_rows = 3;
constexpr double least_span = 0.8; // of a window
constexpr double rounding = 1e-9;  // of a window: a row meant to lie on its rim does

/// What lies within a window of compression.
struct WindowRows
{
  std::vector<double> axial_strain, volumetric_strain, axial_stress;
};

WindowRows rows_between(const TriaxialCurve &curve, const double from, const double to)
{
  WindowRows rows;
  for (std::size_t i = 0; i < curve.size(); ++i)
    if (curve.compression(i) >= from - rounding * to && curve.compression(i) <= to + rounding * to)
    {
      rows.axial_strain.push_back(curve.axial_strain[i]);
      rows.volumetric_strain.push_back(curve.volumetric_strain[i]);
      rows.axial_stress.push_back(curve.axial_stress[i]);
    }
  return rows;
}

bool fill(const WindowRows &rows, const double width)
{
  if (rows.axial_strain.size() < least_rows)
    return false;
  const auto [lowest, highest] = std::minmax_element(rows.axial_strain.begin(), rows.axial_strain.end());
  return *highest - *lowest >= least_span * width;
}

[[noreturn]] void fail_window(const std::string &name, const double from, const double to, const TriaxialCurve &curve)
{
  std::ostringstream message;
  message << "too few rows between the axial strains " << from << " and " << to << " of compression (" << name
          << "): " << rows_between(curve, from, to).axial_strain.size() << " of " << curve.size()
          << " rows, the shear ends at " << curve.compression(curve.size() - 1) << "; at least " << least_rows
          << " rows must span " << 100 * least_span << " % of it: choose another window, or write rows more often";
  throw ConfigError(message.str());
}

double mean_over(const std::vector<double> &values, const std::size_t begin, const std::size_t end)
{
  double sum = 0;
  for (std::size_t i = begin; i < end; ++i)
    sum += values[i];
  return sum / static_cast<double>(end - begin);
}

/// Finds the largest axial pressure; pressures are means over `width` of axial strain around each row.
void find_peak(const TriaxialCurve &curve, const double width, SampleFit &fit)
{
  fit.peak_axial_pressure = -std::numeric_limits<double>::infinity();
  bool reaches_end = false;
  for (std::size_t row = 0; row < curve.size(); ++row)
  {
    const auto is_near = [&](const std::size_t other)
    { return std::abs(curve.compression(other) - curve.compression(row)) <= 0.5 * width * (1 + rounding); };
    std::size_t begin = row, end = row + 1;
    while (begin > 0 && is_near(begin - 1))
      --begin;
    while (end < curve.size() && is_near(end))
      ++end;
    const double axial = -mean_over(curve.axial_stress, begin, end);
    if (axial > fit.peak_axial_pressure)
    {
      fit.peak_axial_pressure = axial;
      fit.peak_lateral_pressure = -mean_over(curve.lateral_stress, begin, end);
      fit.peak_compression = curve.compression(row);
      reaches_end = end == curve.size();
    }
  }
  fit.hardens_to_the_end = reaches_end;
}

void find_final_state(const TriaxialCurve &curve, const double width, SampleFit &fit)
{
  const std::size_t end = curve.size();
  std::size_t begin = end - 1;
  while (begin > 0 && curve.compression(end - 1) - curve.compression(begin - 1) <= width * (1 + rounding))
    --begin;
  fit.final_stress_ratio = mean_over(curve.axial_stress, begin, end) / mean_over(curve.lateral_stress, begin, end);
  fit.critical_solid_fraction = mean_over(curve.solid_fraction, begin, end);
  fit.initial_solid_fraction = curve.solid_fraction.front();
}

void check_signs(const SampleFit &fit)
{
  const auto text = [&]
  {
    std::ostringstream stream;
    stream << "axial stress " << -fit.peak_axial_pressure << " Pa, lateral stress " << -fit.peak_lateral_pressure
           << " Pa at the peak: ";
    return stream.str();
  };
  if (!(fit.peak_lateral_pressure > 0))
    throw ConfigError(text() + "the lateral stress must be compressive; tension is positive in a history");
  if (!(fit.peak_axial_pressure > fit.peak_lateral_pressure))
    throw ConfigError(text() + "the axial pressure must exceed the lateral one somewhere; is z the axial direction?");
}

} // namespace

void FitWindows::validate() const
{
  require(elastic_strain > 0 && elastic_strain < 1, "Elasticity/axial strain", elastic_strain, "in (0, 1)");
  require(peak_average >= 0 && peak_average < 1, "Strength/averaged strain", peak_average, "in [0, 1)");
  require(dilation_from >= 0 && dilation_from < 1, "Dilation/from", dilation_from, "in [0, 1)");
  require(dilation_to > dilation_from && dilation_to < 1, "Dilation/to", dilation_to,
          "above Dilation/from and below 1");
  require(final_average >= 0 && final_average < 1, "Final state/averaged strain", final_average, "in [0, 1)");
}

Line fit_line(const std::span<const double> x, const std::span<const double> y)
{
  const double n = static_cast<double>(x.size());
  double mean_x = 0, mean_y = 0;
  for (std::size_t i = 0; i < x.size(); ++i)
  {
    mean_x += x[i] / n;
    mean_y += y[i] / n;
  }
  double xx = 0, xy = 0;
  for (std::size_t i = 0; i < x.size(); ++i)
  {
    xx += (x[i] - mean_x) * (x[i] - mean_x);
    xy += (x[i] - mean_x) * (y[i] - mean_y);
  }
  const double slope = xy / xx;
  return {slope, mean_y - slope * mean_x};
}

std::optional<ElasticFit> elastic_fit(const TriaxialCurve &curve, const double window)
{
  const WindowRows rows = rows_between(curve, 0, window);
  if (!fill(rows, window))
    return std::nullopt;
  return ElasticFit{fit_line(rows.axial_strain, rows.axial_stress).slope,
                    0.5 * (1 - fit_line(rows.axial_strain, rows.volumetric_strain).slope)};
}

double friction_angle(const double axial, const double lateral, const double cohesion)
{
  const double t = (std::sqrt(cohesion * cohesion + lateral * axial) - cohesion) / lateral;
  return 2 * std::atan(t) * degrees - 90;
}

std::optional<Tangent> common_tangent(const std::span<const MohrCircle> circles)
{
  std::vector<double> centres, radii;
  for (const MohrCircle &circle : circles)
  {
    centres.push_back(circle.centre);
    radii.push_back(circle.radius);
  }
  if (centres.empty())
    return std::nullopt;
  const auto [least, largest] = std::minmax_element(centres.begin(), centres.end());
  if (!(*largest - *least > 1e-6 * *largest))
    return std::nullopt;
  const Line line = fit_line(centres, radii);
  if (!(line.slope >= 0 && line.slope < 1))
    return std::nullopt;
  const double angle = std::asin(line.slope);
  return Tangent{angle * degrees, line.intercept / std::cos(angle)};
}

double dilation_angle(const double dilation_rate)
{
  return std::asin(dilation_rate / (2 + dilation_rate)) * degrees;
}

SampleFit fit_sample(const TriaxialCurve &curve, const FitWindows &windows)
{
  if (curve.size() < least_rows)
    throw ConfigError("the shear stage has " + std::to_string(curve.size()) + " rows; at least " +
                      std::to_string(least_rows) + " are needed");
  SampleFit fit{};
  find_peak(curve, windows.peak_average, fit);
  check_signs(fit);
  find_final_state(curve, windows.final_average, fit);

  const auto elastic = elastic_fit(curve, windows.elastic_strain);
  if (!elastic)
    fail_window("Elasticity/axial strain", 0, windows.elastic_strain, curve);
  fit.elastic = *elastic;
  fit.elastic_half = elastic_fit(curve, 0.5 * windows.elastic_strain);
  fit.elastic_double = elastic_fit(curve, 2 * windows.elastic_strain);

  const WindowRows rows = rows_between(curve, windows.dilation_from, windows.dilation_to);
  if (!fill(rows, windows.dilation_to - windows.dilation_from))
    fail_window("Dilation/from, Dilation/to", windows.dilation_from, windows.dilation_to, curve);
  fit.dilation_rate = -fit_line(rows.axial_strain, rows.volumetric_strain).slope;
  if (!(fit.dilation_rate > -1))
    throw ConfigError("the volume shrinks faster (" + std::to_string(fit.dilation_rate) +
                      ") than without any lateral strain between Dilation/from and Dilation/to; "
                      "check volumetric_strain and the window");
  fit.dilation_angle = dilation_angle(fit.dilation_rate);
  return fit;
}

} // namespace bergamo::driver
