#pragma once

#include "fe_dealii/material/tensor.h"

#include <algorithm>
#include <cmath>

namespace bergamo::fe
{

/// The factor F by which von Wolffersdorff (1996) reaches the surface of Matsuoka and Nakai (1974): with
/// T̂ = T/tr T and its deviator T̂*, the critical stresses are those of ‖T̂*‖ = F/a. 1 on the hydrostatic axis and in
/// triaxial compression, less elsewhere:
///   F = sqrt(tan²ψ/8 + (2 − tan²ψ)/(2 + √2 tan ψ cos 3θ)) − tan ψ/(2√2),
///   tan ψ = √3 ‖T̂*‖,   cos 3θ = −√6 tr T̂*³/‖T̂*‖³.
/// T̂ is the same with either sign of T. @param deviator T̂*, xx yy zz xy yz zx, tensor shears [-]. Beyond tan ψ = √2,
/// which no compressive stress exceeds, F is that of √2 at the same angle.
inline double matsuoka_nakai_factor(const Stress &deviator)
{
  const auto &[x, y, z, xy, yz, zx] = deviator;
  const double square = x * x + y * y + z * z + 2 * (xy * xy + yz * yz + zx * zx);
  if (square == 0)
    return 1;
  // tr T̂*³ = 3 det T̂* without a trace, so √2 tan ψ cos 3θ is −18 det/‖T̂*‖², which needs no angle.
  const double determinant = x * (y * z - yz * yz) - xy * (xy * z - yz * zx) + zx * (xy * yz - y * zx);
  constexpr double greatest = (2 - 1e-9) / 3; // of the square; at 2/3 in triaxial compression the quotient is 0/0
  const double bounded = std::min(square, greatest);
  const double lode = -18 * determinant / square * std::sqrt(bounded / square);
  return std::sqrt(0.375 * bounded + (2 - 3 * bounded) / (2 + lode)) - std::sqrt(0.375 * bounded);
}

} // namespace bergamo::fe
