#include "dem/measure/tensor.h"

#include <Eigen/Eigenvalues>
#include <cmath>

namespace bergamo::dem
{
namespace
{

Mat3 symmetric_part(const Mat3 &tensor)
{
  return 0.5 * (tensor + tensor.transpose());
}

} // namespace

Mat3 deviator(const Mat3 &tensor)
{
  return symmetric_part(tensor) - tensor.trace() / 3. * Mat3::Identity();
}

double equivalent(const Mat3 &tensor)
{
  return std::sqrt(1.5) * deviator(tensor).norm();
}

Vec3 principal_values(const Mat3 &tensor)
{
  return Eigen::SelfAdjointEigenSolver<Mat3>(symmetric_part(tensor), Eigen::EigenvaluesOnly).eigenvalues();
}

} // namespace bergamo::dem
