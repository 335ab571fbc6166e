#include "drivers/fit_mohr_coulomb/sand_tests.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace bergamo::driver
{
namespace
{

/// Solid fraction at a pressure, linear in its logarithm between the rows with ever larger pressure.
double solid_fraction_at(const double pressure, const CompressionCurve &curve)
{
  double below = 0, at_below = 0;
  for (std::size_t row = 0; row < curve.size(); ++row)
  {
    const double p = curve.pressure[row];
    if (p <= below)
      continue;
    if (p >= pressure)
    {
      if (below == 0)
        return curve.solid_fraction[row];
      const double share = std::log(pressure / below) / std::log(p / below);
      return at_below + share * (curve.solid_fraction[row] - at_below);
    }
    below = p;
    at_below = curve.solid_fraction[row];
  }
  return at_below;
}

/// @param from, to pressures that all curves reach [Pa]
CompressionCurve mean_compression(const std::vector<const CompressionCurve *> &curves, const double from,
                                  const double to, const std::size_t n_points)
{
  CompressionCurve mean;
  for (std::size_t i = 0; i < n_points; ++i)
  {
    const double pressure = from * std::pow(to / from, static_cast<double>(i) / static_cast<double>(n_points - 1));
    double sum = 0;
    for (const CompressionCurve *curve : curves)
      sum += solid_fraction_at(pressure, *curve);
    mean.pressure.push_back(pressure);
    mean.solid_fraction.push_back(sum / static_cast<double>(curves.size()));
  }
  return mean;
}

SandTest test_of(const std::vector<const Sample *> &samples, const std::size_t n_points, const double compression_from)
{
  const Sample &first = *samples.front();
  std::vector<const TriaxialCurve *> shears;
  std::vector<const CompressionCurve *> compressions;
  const double from = compression_from * first.confining_pressure;
  double to = first.confining_pressure;
  for (const Sample *sample : samples)
  {
    shears.push_back(&sample->curve);
    const std::vector<double> &pressure = sample->compression.pressure;
    const auto reaches = std::max_element(pressure.begin(), pressure.end());
    if (pressure.size() < 3 || pressure.front() > from || *reaches < 2 * from)
      continue;
    compressions.push_back(&sample->compression);
    to = std::min(to, *reaches);
  }
  SandTest test{first.generation_friction, first.confining_pressure, samples.size(), mean_curve(shears, n_points), {}};
  if (!compressions.empty())
    test.compression = mean_compression(compressions, from, to, std::max<std::size_t>(2, n_points / 4));
  return test;
}

} // namespace

std::vector<double> SandTest::axial_strains() const
{
  std::vector<double> strains;
  for (const MeanPoint &point : shear)
    strains.push_back(point.axial_strain);
  return strains;
}

std::vector<SandTest> sand_tests(const std::vector<Sample> &samples, const std::size_t n_points,
                                 const double compression_from)
{
  std::map<std::pair<double, double>, std::vector<const Sample *>> groups;
  for (const Sample &sample : samples)
    groups[{sample.generation_friction, sample.confining_pressure}].push_back(&sample);
  std::vector<SandTest> tests;
  for (const auto &[key, group] : groups)
    tests.push_back(test_of(group, n_points, compression_from));
  return tests;
}

} // namespace bergamo::driver
