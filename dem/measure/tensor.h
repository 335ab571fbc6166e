#pragma once

#include "dem/core/types.h"

namespace bergamo::dem
{

/// Symmetric part less its mean, as all of this file of the symmetric part.
Mat3 deviator(const Mat3 &tensor);

/// sqrt(3/2 D:D) of the deviator D: |a - b| for the principal values a, b, b (von Mises 1913).
double equivalent(const Mat3 &tensor);

/// Principal values, ascending.
Vec3 principal_values(const Mat3 &tensor);

} // namespace bergamo::dem
