#pragma once

#include "dem/geometry/clump.h"

namespace bergamo::dem
{

/// Of a rigid body of density 1, in the frame in which the body was given.
struct MassProperties
{
  double volume = 0.;                              ///< [m^3]
  Vec3 centre = Vec3::Zero();                      ///< of mass [m]
  Vec3 inertia = Vec3::Zero();                     ///< principal moments about the centre [m^5]
  Quaternion orientation = Quaternion::Identity(); ///< unit, principal frame to the given one

  double volume_error = 0.;  ///< estimate of the quadrature's error, 0 where closed forms hold [m^3]
  double centre_error = 0.;  ///< [m]
  double inertia_error = 0.; ///< of an entry of the tensor about the centre [m^5]
};

/// Mass properties of the union of a clump's parts.
///
/// The closed forms of all parts are summed up; what a part shares with larger ones is taken off by quadrature. Parts
/// that share nothing are exact, so is one that lies inside another (it adds nothing) or is given twice. A clump of one
/// part has that part's own volume, moments and frame, bit for bit. Otherwise principal moments ascend, the larger
/// component of the first two principal axes is positive, and the third one completes a right-handed frame; where
/// moments are equal, rounding chooses among the axes that are right.
///
/// Along its third axis a part is a chord in closed form, a larger part another one (the gauge of a convex body is
/// convex along a line: Newton's method from outside is monotone), and the integral over the union of chords is exact.
/// Over the other two axes the Gauss-Kronrod rule of 15 points is halved adaptively (Piessens et al. 1983, QAG), one
/// axis inside the other, between the ends of the overlap: its depth along the chord is concave over the section and
/// its maximum is concave over the sections, so the ends are found, and a pair of parts that share nothing is known.
/// Everything is in the part's own coordinates, half-axes one: the aspect ratio does not count.
///
/// @param tolerance of the integrals in these coordinates, in [1e-10, 1e-2]. A part that shares something with two
/// others takes some seconds at 1e-8 and a tenth of that at 1e-4.
/// @throws ConfigError for an impossible clump or tolerance
MassProperties mass_properties(const ClumpShape &clump, double tolerance = 1e-6);

/// The clump in the principal frame about its centre of mass.
ClumpShape in_principal_frame(const ClumpShape &clump, const MassProperties &mass);

} // namespace bergamo::dem
