#include "drivers/common/grading_parameters.h"

#include "drivers/common/clump_parameters.h"
#include "drivers/common/grain_parameters.h"

#include <random>
#include <variant>

namespace bergamo::driver
{

GradingParameters::GradingParameters()
{
  // A bent grain of three rounded parts.
  clump.parts = {{{Vec3(0.7, 0.5, 0.5), 0.8, 0.8}},
                 {{Vec3(0.4, 0.4, 0.6), 1., 1.}, Vec3(0.8, 0., 0.5)},
                 {{Vec3(0.45, 0.45, 0.45), 1., 1.}, Vec3(-0.8, 0.1, 0.)}};
}

void GradingParameters::declare(ParameterFile &file)
{
  file.add("Grains", "shape", shape, "superquadrics, or clumps of several, which Grains/Clumps describes",
           {{"superquadrics", ShapeKind::superquadrics}, {"clumps", ShapeKind::clumps}});
  file.add_bound("Grains/Clumps", "parts",
                 "of every clump, relative to one another; the clump is scaled to the volume of a grain drawn from the "
                 "sizes, or to its opening where these are sieves",
                 bind_clump(clump));
  file.add("Grains", "sizes", kind, "which of the three sections below counts",
           {{"gaussian", SizeKind::gaussian}, {"uniform", SizeKind::uniform}, {"sieves", SizeKind::sieves}});
  declare_distribution(file, "Grains/Gaussian", gaussian);
  file.add("Grains/Uniform", "smallest diameter", uniform.smallest_diameter, "of the sphere of equal volume [m]",
           Range::positive().usual(1e-6, 0.1));
  file.add("Grains/Uniform", "largest diameter", uniform.largest_diameter, "[m]", Range::positive().usual(1e-6, 0.1));
  file.add("Grains/Sieves", "d10", d10, "opening that a tenth of the mass passes [m]",
           Range::positive().usual(1e-6, 0.1));
  file.add("Grains/Sieves", "d50", d50, "[m]", Range::positive().usual(1e-6, 0.1));
  file.add("Grains/Sieves", "d60", d60, "[m]", Range::positive().usual(1e-6, 0.1));
  file.add("Grains/Shapes", "elongation", uniform.shapes.elongation,
           "largest ratio of two half-axes, for uniform sizes and sieves", Range::at_least(1).usual(1, 10));
  file.add("Grains/Shapes", "angularity", uniform.shapes.angularity,
           "largest distance of an exponent from 1, for uniform sizes and sieves",
           {.lowest = 0, .highest = 1, .highest_included = false});
}

void GradingParameters::validate(const dem::PackingParameters &packing) const
{
  std::visit([](const auto &sizes) { sizes.validate(); }, grading());
  packing.validate();
  if (shape == ShapeKind::clumps)
  {
    clump.validate();
    packing.validate_for_clumps();
  }
}

dem::ClumpGrading GradingParameters::clump_grading() const
{
  constexpr double tolerance = 1e-4; // of the volume; the finer it is, the longer overlapping parts take
  return {dem::Clump(clump, tolerance), grading()};
}

dem::Particles GradingParameters::draw(const double solid_volume, const std::uint64_t seed) const
{
  std::mt19937_64 generator(seed);
  dem::Particles particles;
  const auto add = [&](const auto &grains)
  {
    for (const auto &grain : grains)
      particles.add(grain, 1., Vec3::Zero(), Quaternion::Identity());
  };
  if (shape == ShapeKind::clumps)
    add(dem::draw_clumps(clump_grading(), solid_volume, generator));
  else
    add(dem::draw_grains(grading(), solid_volume, generator));
  return particles;
}

dem::PackedGrains GradingParameters::pack(const dem::PackingSpace &space, const dem::PackingParameters &parameters,
                                          const std::uint64_t seed) const
{
  return shape == ShapeKind::clumps ? dem::pack_clumps(clump_grading(), space, parameters, seed)
                                    : dem::pack_grains(grading(), space, parameters, seed);
}

dem::Grading GradingParameters::grading() const
{
  switch (kind)
  {
  case SizeKind::uniform:
    return uniform;
  case SizeKind::sieves:
    return dem::SieveCurve::through(d10, d50, d60, uniform.shapes);
  default:
    return gaussian;
  }
}

} // namespace bergamo::driver
