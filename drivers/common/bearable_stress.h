#pragma once

#include "dem/core/types.h"
#include "fe_dealii/material/material.h"

namespace bergamo::driver
{

/// A stress with as much of its deviator as a law bears: a small packing's may be beyond what a continuum has for it.
/// Only Mohr-Coulomb has a bound. @param stress xx, yy, zz, of a pressure; tension positive [Pa]
Vec3 bearable(const fe::Material &material, const Vec3 &stress);

} // namespace bergamo::driver
