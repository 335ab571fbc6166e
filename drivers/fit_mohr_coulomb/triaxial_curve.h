#pragma once

#include <cstddef>
#include <vector>

namespace bergamo::driver
{

/// Shear stage of a triaxial test at constant lateral pressure, one number a row in each vector. Tension is positive,
/// so compression has negative strains and stresses. The axial direction (3 in the dissertation) is compressed; both
/// lateral ones (1, 2) bear the confining pressure. Strains are engineering strains, L/L0 − 1 and V/V0 − 1, since the
/// isotropic state under that pressure.
struct TriaxialCurve
{
  std::vector<double> axial_strain;
  std::vector<double> volumetric_strain;
  std::vector<double> axial_stress;   ///< [Pa]
  std::vector<double> lateral_stress; ///< mean of the two lateral stresses [Pa]
  std::vector<double> solid_fraction;

  std::size_t size() const { return axial_strain.size(); }
  double compression(const std::size_t row) const { return -axial_strain[row]; }
  double stress_ratio(const std::size_t row) const { return axial_stress[row] / lateral_stress[row]; } ///< σ3/σ1
};

} // namespace bergamo::driver
