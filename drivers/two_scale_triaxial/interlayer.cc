#include "drivers/two_scale_triaxial/interlayer.h"

#include "dem/core/error.h"

#include <cmath>

namespace bergamo::driver
{

Interlayer::Interlayer(const ElementLayers &layers, const dem::Box &cell)
    : middle_(0.5 * (cell.low[2] + cell.high[2])),
      inner_(cell.edges()[2] * (0.5 * layers.continuum - layers.overlap) / layers.high()),
      outer_(cell.edges()[2] * 0.5 * layers.continuum / layers.high())
{
}

double Interlayer::from_middle(const Vec3 &place) const
{
  return std::abs(place[2] - middle_);
}

double Interlayer::weight_at(const Vec3 &place, const coupling::WeightShape shape) const
{
  const double way = (from_middle(place) - inner_) / (outer_ - inner_);
  constexpr double rounding = 1e-9;
  return way < rounding ? 0. : way > 1. - rounding ? 1. : coupling::weight_at(shape, way);
}

void require_interlayer(const ElementLayers &layers)
{
  if (layers.continuum >= layers.high())
    reject("Model/continuum layers is ", layers.continuum, " of ", layers.high(),
           " layers (Model/elements per height): at least one layer must be left to the grains alone");
  if ((layers.high() - layers.continuum) % 2 != 0)
    reject("Model/continuum layers is ", layers.continuum, " of ", layers.high(),
           " layers (Model/elements per height): half-way up, its faces would lie within layers; choose both even or "
           "both odd");
  if (2 * layers.overlap >= layers.continuum)
    reject("Model/overlap layers is ", layers.overlap, " at either face of a continuum of ", layers.continuum,
           " layers: at least one layer must be left to the continuum alone");
}

} // namespace bergamo::driver
