#pragma once

#include "dem/core/types.h"

#include <span>

namespace bergamo::dem
{

/// Sizes of grains that a surface is to touch [m].
struct GrainSizes
{
  double smallest_radius, largest_radius;
};

/// Between what a surface's extent may lie.
struct SurfaceSizeLimits
{
  double smallest = 1.; ///< times the smallest radius
  double largest = 1e4; ///< times the largest radius
};

/// Longest side of the box around places, along the axes [m].
double extent_of(std::span<const Vec3> node);

/// Finds lengths of another unit: millimetres taken for metres make a surface a thousand times too large, metres for
/// millimetres one that is too small. A surface that grains flow along or rest in is 10 radii long at least, and 1000
/// where a hundred million of them fill it; a channel for few of them side by side may have 10 000. So the limits find
/// that factor for all surfaces of 10 to 1000 radii, and refuse nothing that could be run but a surface smaller than
/// any grain: whoever means that gives other limits. The largest radius counts above and the smallest below, so a wide
/// grading refuses less.
/// @param node places [m], at least one. Throws ConfigError naming extent, sizes and remedy.
void check_size_against_grains(std::span<const Vec3> node, const GrainSizes &grains,
                               const SurfaceSizeLimits &limits = {});

} // namespace bergamo::dem
