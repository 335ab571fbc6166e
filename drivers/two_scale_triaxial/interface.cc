#include "drivers/two_scale_triaxial/interface.h"

#include "dem/core/error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace bergamo::driver
{
namespace
{

constexpr double swing = 0.2; // of the height, by an inclined or a curved face

/// @param share of the way along x
double stretch_at(const InterfaceShape shape, const double share)
{
  if (shape == InterfaceShape::inclined)
    return 1. + swing * (2. * share - 1.);
  if (shape == InterfaceShape::curved)
    return 1. - swing * std::cos(2. * std::numbers::pi * share);
  return 1.;
}

} // namespace

void ElementLayers::validate(const InterfaceShape shape) const
{
  const bool sways = shape == InterfaceShape::inclined || shape == InterfaceShape::curved;
  const double highest = sways ? (1. + swing) * continuum : continuum;
  if (highest >= per_edge)
    reject("Model/continuum layers is ", continuum, " of ", per_edge,
           " layers (Model/elements per edge): at least one layer must be left to the grains alone",
           sways ? ", also where the face (Model/interface) is highest" : "");
  if (shape == InterfaceShape::stepped && overlap < 2)
    reject("Model/overlap layers is ", overlap,
           ": a stepped face (Model/interface) needs at least 2, or the overlap "
           "would have no thickness at the step");
  const unsigned int lowest = shape == InterfaceShape::stepped ? continuum - 1 : continuum;
  if (overlap >= lowest)
    reject("Model/overlap layers is ", overlap, ", as thick as the continuum of ", lowest,
           " layers or thicker: at least one layer must be left to the continuum alone",
           lowest < continuum ? ", also behind the step (Model/interface)" : "");
}

Interface::Interface(const InterfaceShape shape, const ElementLayers &layers, const dem::Box &cube)
    : layers_(layers), cube_(cube), step_(std::numeric_limits<double>::infinity())
{
  for (unsigned int k = 0; k <= layers.per_edge; ++k)
    stretch_.push_back(stretch_at(shape, static_cast<double>(k) / layers.per_edge));
  if (shape == InterfaceShape::stepped)
    step_ = cube.low[0] + cube.edges()[0] * ((layers.per_edge + 1) / 2) / layers.per_edge;
}

double Interface::stretch(const double x) const
{
  const double place = std::clamp((x - cube_.low[0]) / cube_.edges()[0], 0., 1.) * layers_.per_edge;
  const auto column = std::min(static_cast<std::size_t>(place), stretch_.size() - 2);
  return std::lerp(stretch_[column], stretch_[column + 1], place - static_cast<double>(column));
}

double Interface::height(const double x, const unsigned int layer) const
{
  const unsigned int n = x > step_ ? layer - 1 : layer;
  return cube_.low[2] + cube_.edges()[2] * n / layers_.per_edge * stretch(x);
}

double Interface::weight_at(const Vec3 &place, const coupling::WeightShape weight) const
{
  const double x = place[0], z = place[2];
  double above_bottom = z - bottom(x), below_top = top(x) - z;
  if (std::isfinite(step_))
  {
    // Continuum alone and grains alone each lie on both sides of the step; the nearer one counts.
    const double high = cube_.low[0], low = cube_.high[0];
    const double behind = std::max(0., x - step_), before = std::max(0., step_ - x);
    const auto beyond = [](const double height) { return std::max(0., height); };
    above_bottom = std::min(std::hypot(behind, beyond(z - bottom(high))), std::hypot(before, beyond(z - bottom(low))));
    below_top = std::min(std::hypot(behind, beyond(top(high) - z)), std::hypot(before, beyond(top(low) - z)));
  }
  if (above_bottom <= 0.)
    return 0.;
  return below_top <= 0. ? 1. : coupling::weight_at(weight, above_bottom / (above_bottom + below_top));
}

} // namespace bergamo::driver
