#pragma once

#include "fe_dealii/explicit_body.h"

namespace bergamo::fe
{

/// What a solid body may be made of.
enum class Shape
{
  plain,    ///< 8 nodes, strains at their points
  bending,  ///< 8 nodes that bend
  quadratic ///< 27 nodes
};

inline void set_shape(ExplicitBodyParameters &parameters, const Shape shape)
{
  parameters.degree = shape == Shape::quadratic ? 2 : 1;
  parameters.kind.hourglass = shape == Shape::bending ? Hourglass::bending : Hourglass::at_points;
}

} // namespace bergamo::fe
