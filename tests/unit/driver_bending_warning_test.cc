#include "drivers/common/progress.h"
#include "drivers/common/run/bending_warning.h"
#include "fe_dealii/explicit_body.h"
#include "fe_dealii/mesh/box_mesh.h"

#include <catch2/catch.hpp>

#include <sstream>
#include <string>

using namespace bergamo;
using Catch::Matchers::Contains;

namespace
{

std::string warning_of(const fe::Hourglass hourglass)
{
  fe::ExplicitBodyParameters parameters;
  parameters.kind.hourglass = hourglass;
  const fe::ExplicitBody plate = fe::make_box_body({{0, 0, 0}, {8, 4, 1}, {4, 2, 1}}, parameters);
  std::ostringstream stream;
  driver::ProgressOptions options;
  options.quiet = true;
  options.stream = &stream;
  driver::Progress progress(options);
  driver::warn_of_thin_layers(plate, "set Ground/bending elements = true", progress);
  return stream.str();
}

} // namespace

TEST_CASE("thin layers of elements that do not bend are warned of once, by place, with the remedy")
{
  const std::string text = warning_of(fe::Hourglass::at_points);
  CHECK_THAT(text, Contains("warning: continuum: element") && Contains("only 1 element over a thickness of 1 m") &&
                       Contains("2 m long") && Contains("8 in all") &&
                       Contains("set Ground/bending elements = true"));
  CHECK(text.find("warning", 1) == std::string::npos);
  CHECK(warning_of(fe::Hourglass::bending).empty());
}
