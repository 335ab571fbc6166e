#pragma once

#include <cstddef>

namespace bergamo::fe
{

class MovingBody;

/// Where a body is so thin that its elements cannot bend as they should.
struct ThinLayers
{
  std::size_t n_elements = 0; ///< in such layers; 0: there are none, and the rest means nothing
  std::size_t element = 0;    ///< of these the one that is longest over the thickness
  int n_layers = 0;           ///< elements over the thickness there
  double thickness = 0;       ///< from surface to surface [m]
  double length = 0;          ///< of that element [m]
};

/// Elements of 8 nodes that do not bend (see ElementGroup::bends()) and lie alone between two surfaces, or are longer
/// than longest_in_thickness times the distance of these. Bent, layers deflect 1/(1 + (1 − ν)/2 (l/t)²) of what they
/// should, with elements of length l in a thickness t, a single one up to twice as much again
/// (docs/results/continuum.md). Only where the body is more than least_slenderness times as long as that thickness; and
/// not where one of the surfaces is held across, as in plane strain or on a rigid base: nothing bends there. Call when
/// all conditions are set.
ThinLayers thin_layers(const MovingBody &body);

inline constexpr double longest_in_thickness = 0.5; ///< 8 % too stiff at ν = 0.3
inline constexpr double least_slenderness = 5;

} // namespace bergamo::fe
