#pragma once

#include "dem/state/particles.h"

namespace bergamo::dem
{

/// Mean grain of an assembly.
struct MeanGrain
{
  double mass = 0.;     ///< [kg]
  double diameter = 0.; ///< of the sphere of equal volume [m]
};

/// Arithmetic means over the grains but for fixed ones; zeros without grains.
MeanGrain mean_grain(const Particles &particles);

/// Inertial number I = rate sqrt(m / (d p)) with the average mass and diameter (Wellmann 4.3.4, 5.1.3; da Cruz et al.
/// 2005). The limit of slow deformation is reached below about 1e-5 (Agnolin & Roux 2007).
/// @param strain_rate of either sign [1/s]; @param pressure compression positive [Pa]
/// @return infinity without pressure, which is what a gas of grains has
double inertial_number(const MeanGrain &grain, double strain_rate, double pressure);

/// The strain rate of an inertial number [1/s]; 0 without pressure.
double strain_rate_of(const MeanGrain &grain, double inertial_number, double pressure);

} // namespace bergamo::dem
