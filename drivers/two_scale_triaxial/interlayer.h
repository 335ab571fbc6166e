#pragma once

#include "coupling/arlequin/weight.h"
#include "dem/packing/space.h"
#include "drivers/two_scale_triaxial/interface.h"

namespace bergamo::driver
{

/// A layer of continuum half-way up a periodic cell, with grains above and below: two flat overlaps.
class Interlayer
{
public:
  /// @param layers valid for it, see require_interlayer()
  Interlayer(const ElementLayers &layers, const dem::Box &cell);

  double bottom() const { return middle_ - outer_; } ///< of the continuum [m]
  double top() const { return middle_ + outer_; }    ///< [m]

  /// Weight of the grains at a place [m]: by the way through either overlap from its inner to its outer face.
  double weight_at(const Vec3 &place, coupling::WeightShape shape) const;

  bool has_grain(const Vec3 &centre) const { return from_middle(centre) >= inner_; }
  bool is_of_grains_alone(const Vec3 &centre) const { return from_middle(centre) > outer_; }

private:
  double from_middle(const Vec3 &place) const;

  double middle_, inner_, outer_; // height; faces of the overlaps from there [m]
};

/// Throws ConfigError where the grains or the continuum have no layer to themselves.
void require_interlayer(const ElementLayers &layers);

} // namespace bergamo::driver
