#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace bergamo::dem
{

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;
using Quaternion = Eigen::Quaterniond; ///< unit, turns body vectors into global ones

} // namespace bergamo::dem
