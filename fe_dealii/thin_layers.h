#pragma once

#include <cstddef>

namespace bergamo::fe
{

class MovingBody;

/// Where a body is so thin that its elements cannot bend as they should.
struct ThinLayers
{
  std::size_t n_elements = 0; ///< in such layers; 0: there are none, and the rest means nothing
  std::size_t element = 0;    ///< of these the one that is longest over its own thickness
  int n_layers = 0;           ///< elements over the thickness there
  double thickness = 0;       ///< of these layers together [m]
  double aspect = 0;          ///< length over thickness of that element
};

/// Elements of 8 nodes that do not bend (see ElementGroup::bends()) with most_thin_layers or fewer of them between two
/// surfaces, where the body is more than least_slenderness times as long as that is thick. Not where one of the
/// surfaces is held across, as in plane strain or on a rigid base: no layer bends there. Call when all conditions are
/// set.
ThinLayers thin_layers(const MovingBody &body);

/// Four elements over the thickness are 4 % off in bending where they are cubes (docs/results/continuum.md).
inline constexpr int most_thin_layers = 2;
inline constexpr double least_slenderness = 5;

} // namespace bergamo::fe
