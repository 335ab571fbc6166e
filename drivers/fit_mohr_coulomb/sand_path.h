#pragma once

#include "drivers/fit_mohr_coulomb/triaxial_path.h"
#include "fe_dealii/material/hypoplastic.h"

#include <span>
#include <vector>

namespace bergamo::driver
{

/// The triaxial test of drive_triaxial() on one point of sand, whose void ratio at the start is that of the solid
/// fraction there. The law gets logarithmic strains, so that void ratio and volume go together at any strain; those of
/// the curve are engineering strains, as the grains'. Throws RunError where no lateral strain holds the pressure.
TriaxialCurve drive_triaxial(const fe::HypoplasticSand &sand, const TriaxialStart &start,
                             std::span<const double> axial_strains);

/// Isotropic compression of a point. @param pressures [Pa], rising, the first one that of the start
/// @param solid_fraction at the first @return that at each. Throws RunError where no strain gives a pressure.
std::vector<double> compress(const fe::HypoplasticSand &sand, std::span<const double> pressures, double solid_fraction);
std::vector<double> compress(const fe::MohrCoulomb &material, std::span<const double> pressures, double solid_fraction);

} // namespace bergamo::driver
