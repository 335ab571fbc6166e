#pragma once

#include "dem/packing/grading.h"

namespace bergamo::dem
{

/// No grain of a valid grading reaches further from its centre [m]: the least such bound for half-axes that are
/// Gaussian or given by sieves, and at most the elongation's cube root above it for uniform sizes. A superquadric holds
/// every one of smaller half-axes and greater exponents, so it follows from the extremes of both.
double largest_bounding_radius(const Grading &grading);

} // namespace bergamo::dem
