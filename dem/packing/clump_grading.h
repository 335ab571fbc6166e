#pragma once

#include "dem/geometry/rigid_clump.h"
#include "dem/packing/grading.h"

#include <random>
#include <vector>

namespace bergamo::dem
{

/// One kind of clump in many sizes: each one takes the place of a grain drawn from a grading. It has that grain's
/// volume, and of a sieve curve its sieve size instead.
struct ClumpGrading
{
  Clump unit; ///< of any size
  Grading sizes;
};

/// One random clump.
Clump draw_clump(const ClumpGrading &grading, std::mt19937_64 &generator);

/// Clumps until their volume reaches solid_volume [m^3] as nearly as whole ones can. Throws ConfigError for a grading
/// or a volume out of its range.
std::vector<Clump> draw_clumps(const ClumpGrading &grading, double solid_volume, std::mt19937_64 &generator);

/// The middle one of the widths along the principal axes, for the opening that a clump passes [m].
double sieve_size(const Clump &clump);

} // namespace bergamo::dem
