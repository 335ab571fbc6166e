#pragma once

#include "drivers/fit_mohr_coulomb/triaxial_curve.h"
#include "fe_dealii/material/mohr_coulomb.h"

#include <span>

namespace bergamo::driver
{

/// Isotropic state that a triaxial test starts from.
struct TriaxialStart
{
  double confining_pressure;       ///< [Pa], > 0
  double initial_solid_fraction{}; ///< the curve's solid fraction follows from it and the volume
};

/// The test on one point of the material, which is an element in a homogeneous state: the axial strains are prescribed
/// (tension positive, the first one is reached from 0), the lateral stresses are held by equal lateral strains. Strains
/// are small, εV their trace. Throws RunError where no lateral strain holds the pressure.
TriaxialCurve drive_triaxial(const fe::MohrCoulomb &material, const TriaxialStart &start,
                             std::span<const double> axial_strains);

} // namespace bergamo::driver
