#include "drivers/common/grading_parameters.h"

#include "drivers/common/grain_parameters.h"

#include <variant>

namespace bergamo::driver
{

void GradingParameters::declare(ParameterFile &file)
{
  file.add("Grains", "sizes", kind, "which of the three sections below counts",
           {{"gaussian", SizeKind::gaussian}, {"uniform", SizeKind::uniform}, {"sieves", SizeKind::sieves}});
  declare_distribution(file, "Grains/Gaussian", gaussian);
  file.add("Grains/Uniform", "smallest diameter", uniform.smallest_diameter, "of the sphere of equal volume [m]",
           Range::positive());
  file.add("Grains/Uniform", "largest diameter", uniform.largest_diameter, "[m]", Range::positive());
  file.add("Grains/Sieves", "d10", d10, "opening that a tenth of the mass passes [m]", Range::positive());
  file.add("Grains/Sieves", "d50", d50, "[m]", Range::positive());
  file.add("Grains/Sieves", "d60", d60, "[m]", Range::positive());
  file.add("Grains/Shapes", "elongation", uniform.shapes.elongation,
           "largest ratio of two half-axes, for uniform sizes and sieves", Range::at_least(1));
  file.add("Grains/Shapes", "angularity", uniform.shapes.angularity,
           "largest distance of an exponent from 1, for uniform sizes and sieves",
           {.lowest = 0, .highest = 1, .highest_included = false});
}

void GradingParameters::validate() const
{
  std::visit([](const auto &sizes) { sizes.validate(); }, grading());
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
