#include "drivers/fit_mohr_coulomb/law_misfit.h"

#include "drivers/fit_mohr_coulomb/sand_path.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace bergamo::driver
{
namespace
{

enum Kind
{
  ratio,
  volume,
  compression,
  n_kinds
};

/// Calls take(kind, grains, law) with the values of every point.
template <class Take>
void for_each_value(const std::vector<SandTest> &tests, const std::vector<LawCurves> &curves, const Take &take)
{
  for (std::size_t t = 0; t < tests.size(); ++t)
  {
    const SandTest &test = tests[t];
    const LawCurves &law = curves[t];
    const double start = test.shear.front().volumetric_strain.mean; // which the law's curve counts from
    for (std::size_t i = 0; i < test.shear.size(); ++i)
    {
      take(ratio, test.shear[i].stress_ratio.mean - 1, law.shear.stress_ratio(i) - 1);
      take(volume, test.shear[i].volumetric_strain.mean - start, law.shear.volumetric_strain[i]);
    }
    const std::vector<double> &grains = test.compression.solid_fraction;
    for (std::size_t i = 0; i < grains.size(); ++i)
      take(compression, grains.front() / grains[i] - 1,
           law.compressed_solid_fraction.front() / law.compressed_solid_fraction[i] - 1);
  }
}

std::array<double, n_kinds> squares_of_grains(const std::vector<SandTest> &tests, const std::vector<LawCurves> &curves)
{
  std::array<double, n_kinds> squares{};
  for_each_value(tests, curves,
                 [&](const Kind kind, const double grains, const double) { squares[kind] += grains * grains; });
  return squares;
}

} // namespace

template <class Law>
LawCurves curves_of(const Law &law, const SandTest &test)
{
  LawCurves curves;
  curves.shear = drive_triaxial(law, {test.confining_pressure, test.initial_solid_fraction()}, test.axial_strains());
  if (test.compression.size() > 0)
    curves.compressed_solid_fraction =
        compress(law, test.compression.pressure, test.compression.solid_fraction.front());
  return curves;
}
template LawCurves curves_of(const fe::HypoplasticSand &law, const SandTest &test);
template LawCurves curves_of(const fe::MohrCoulomb &law, const SandTest &test);

std::vector<double> differences(const std::vector<SandTest> &tests, const std::vector<LawCurves> &curves)
{
  const std::array<double, n_kinds> squares = squares_of_grains(tests, curves);
  const double n_present = static_cast<double>(n_kinds - std::count(squares.begin(), squares.end(), 0.));
  std::vector<double> result;
  for_each_value(tests, curves,
                 [&](const Kind kind, const double grains, const double law)
                 {
                   if (squares[kind] > 0)
                     result.push_back((law - grains) / std::sqrt(squares[kind] * n_present));
                 });
  return result;
}

Misfit misfit(const std::vector<SandTest> &tests, const std::vector<LawCurves> &curves)
{
  const std::array<double, n_kinds> squares = squares_of_grains(tests, curves);
  std::array<double, n_kinds> off{};
  for_each_value(tests, curves,
                 [&](const Kind kind, const double grains, const double law)
                 { off[kind] += (law - grains) * (law - grains); });
  const auto relative = [&](const Kind kind) { return squares[kind] > 0 ? std::sqrt(off[kind] / squares[kind]) : 0; };
  double sum = 0;
  for (const double difference : differences(tests, curves))
    sum += difference * difference;
  return {std::sqrt(sum), relative(ratio), relative(volume), relative(compression)};
}

} // namespace bergamo::driver
