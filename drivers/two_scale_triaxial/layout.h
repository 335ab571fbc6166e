#pragma once

#include "drivers/two_scale_triaxial/interface.h"
#include "drivers/two_scale_triaxial/interlayer.h"

#include <variant>

namespace bergamo::driver
{

/// Where grains and continuum lie in a specimen: grains above one face of the continuum, or on both of its sides.
using Layout = std::variant<Interface, Interlayer>;

/// Weight of the grains at a place [m].
inline double weight_at(const Layout &layout, const Vec3 &place, const coupling::WeightShape shape)
{
  return std::visit([&](const auto &of) { return of.weight_at(place, shape); }, layout);
}

/// Whether a grain with its centre there [m] belongs to the specimen: not where the continuum is alone.
inline bool has_grain(const Layout &layout, const Vec3 &centre)
{
  return std::visit([&](const auto &of) { return of.has_grain(centre); }, layout);
}

/// Whether it lies beyond the continuum.
inline bool is_of_grains_alone(const Layout &layout, const Vec3 &centre)
{
  return std::visit([&](const auto &of) { return of.is_of_grains_alone(centre); }, layout);
}

} // namespace bergamo::driver
