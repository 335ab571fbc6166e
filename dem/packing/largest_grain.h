#pragma once

#include "dem/packing/grading.h"

namespace bergamo::dem
{

/// No grain of a valid grading reaches further from its centre [m]: the least such bound for half-axes that are
/// Gaussian or given by sieves, one with some room to spare for uniform sizes, whose grains cannot have all extremes at
/// once. A superquadric holds every one of smaller half-axes and greater exponents.
double largest_bounding_radius(const Grading &grading);

} // namespace bergamo::dem
