#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace bergamo
{

/// Real is double or a SIMD pack of doubles (dem/core/pack.h).
template <class Real>
using Vector3 = Eigen::Matrix<Real, 3, 1>;
template <class Real>
using Vector2 = Eigen::Matrix<Real, 2, 1, Eigen::DontAlign>; // so that structs of numbers have no holes
template <class Real>
using Matrix3 = Eigen::Matrix<Real, 3, 3>;

using Vec2 = Vector2<double>;
using Vec3 = Vector3<double>;
using Mat3 = Matrix3<double>;
using Quaternion = Eigen::Quaterniond; ///< unit, turns body vectors into global ones

} // namespace bergamo
