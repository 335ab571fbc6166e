#pragma once

#include "dem/core/types.h"

namespace bergamo::dem
{

/// Integrals over a body of 1, x, y, z, xx, yy, zz, xy, xz, yz, in this order.
using Moments = Eigen::Array<double, 10, 1>;

/// The integral of x x^T.
inline Mat3 second_moments(const Moments &m)
{
  Mat3 second;
  second << m[4], m[7], m[8], m[7], m[5], m[9], m[8], m[9], m[6];
  return second;
}

/// The tensor of inertia of density 1. @param second the integral of x x^T
inline Mat3 inertia_of(const Mat3 &second)
{
  return second.trace() * Mat3::Identity() - second;
}

} // namespace bergamo::dem
