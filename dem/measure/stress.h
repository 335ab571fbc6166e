#pragma once

#include "dem/measure/contact_list.h"
#include "dem/measure/tensor.h"

#include <Eigen/Geometry>
#include <span>

namespace bergamo::dem
{

/// Sum of branch (x) force on body 1 with the contacts' weights: the mean stress times the volume, tension positive
/// [N m]. Global frame; first index the branch, second the force. Grains at rest: what accelerates them adds
/// - sum x (x) resultant. Symmetric where the torques balance.
Mat3 force_moment(std::span<const TouchingContact> contacts);

/// Mean Cauchy stress of a volume from all its contacts, tension positive [Pa] (Wellmann 5.4, 5.5; Love 1927): in a
/// periodic cell those between grains, of a packing between walls also those with walls.
/// @param volume [m^3]; @throws ConfigError if it is not positive
Mat3 mean_stress(std::span<const TouchingContact> contacts, double volume);

/// Mean stress of a cell cut out of a larger assembly, from the contacts whose points lie inside, faces at the lower
/// end included [Pa] (Wellmann 6.4).
Mat3 mean_stress(std::span<const TouchingContact> contacts, const Particles &particles,
                 const Eigen::AlignedBox3d &cell);

/// Minus the mean normal stress: compression positive [Pa].
inline double pressure(const Mat3 &stress)
{
  return -stress.trace() / 3.;
}

/// |sigma_1 - sigma_3| of a triaxial test [Pa].
inline double deviatoric_stress(const Mat3 &stress)
{
  return equivalent(stress);
}

/// Principal stresses, the most compressive first [Pa].
inline Vec3 principal_stresses(const Mat3 &stress)
{
  return principal_values(stress);
}

} // namespace bergamo::dem
