#pragma once

#include "dem/geometry/clump.h"
#include "drivers/common/parameter_binding.h"

namespace bergamo::driver
{

/// The parts of a clump, separated by semicolons, each as "x y z  r1 r2 r3  eps1 eps2": its place, half-axes and
/// exponents; then, where it is turned, " w x y z" of its quaternion. The variable must outlive the binding.
ParameterBinding bind_clump(dem::ClumpShape &clump);

} // namespace bergamo::driver
