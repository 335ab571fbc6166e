#pragma once

#include "drivers/common/run/state_visitor.h"

namespace bergamo::driver
{

/// The straight line through samples over depth, by least squares.
class DepthTrend
{
public:
  void add(const double depth, const double value)
  {
    n += 1.;
    sum_depth += depth;
    sum_value += value;
    sum_square += depth * depth;
    sum_product += depth * value;
  }

  /// Change of the value over the depth; 0 for less than two depths.
  double slope() const
  {
    const double spread = n * sum_square - sum_depth * sum_depth;
    return spread > 0. ? (n * sum_product - sum_depth * sum_value) / spread : 0.;
  }
  double mean() const { return n > 0. ? sum_value / n : 0.; }
  double mean_depth() const { return n > 0. ? sum_depth / n : 0.; }

  void visit(StateVisitor &visit)
  {
    visit("trend/n", n);
    visit("trend/sum_depth", sum_depth);
    visit("trend/sum_value", sum_value);
    visit("trend/sum_square", sum_square);
    visit("trend/sum_product", sum_product);
  }

private:
  double n = 0., sum_depth = 0., sum_value = 0., sum_square = 0., sum_product = 0.;
};

} // namespace bergamo::driver
