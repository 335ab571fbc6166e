#pragma once

#include <cstddef>

namespace bergamo::fe
{

class MovingBody;

struct ElementRotation
{
  double angle = 0;        ///< [degrees], in [0, 180]
  std::size_t element = 0; ///< the one that has turned most
};

/// Beyond this, laws of small strain see a strain of half a percent in a rotation alone, 1 − cos of it [degrees].
inline constexpr double largest_small_rotation = 5;

/// The rotation of the element that has turned most: that of the affine motion that fits its nodes best, by polar
/// decomposition. Rigid elements do not count. 0 for membranes, whose nodes lie in a plane.
ElementRotation greatest_rotation(const MovingBody &body);

} // namespace bergamo::fe
