#pragma once

#include "coupling/arlequin/weight.h"
#include "dem/packing/space.h"

#include <vector>

namespace bergamo::driver
{

/// How the upper face of the continuum goes along x (Wellmann, fig. 6.7a).
enum class InterfaceShape
{
  flat,
  inclined, ///< from 0.8 to 1.2 of the flat height
  stepped,  ///< by one layer of elements down behind the middle
  curved    ///< a wave of the length of the cube, up and down by a fifth of the flat height
};

/// Layers of elements in a specimen, from the bottom; between grains above and below, from the continuum's lower face.
struct ElementLayers
{
  unsigned int per_edge = 5;   ///< across
  unsigned int continuum = 3;  ///< that are there
  unsigned int overlap = 1;    ///< of these, shared with the grains; as many at either face
  unsigned int per_height = 0; ///< along z; 0: as many as across

  unsigned int high() const { return per_height > 0 ? per_height : per_edge; }

  /// Throws ConfigError where the grains or the continuum have no layer to themselves under a face of this shape.
  void validate(InterfaceShape shape) const;
};

/// The overlap's lower and upper face in a cube: heights over x, from column to column of elements along straight
/// lines.
class Interface
{
public:
  /// @param layers valid for the shape
  Interface(InterfaceShape shape, const ElementLayers &layers, const dem::Box &cube);

  double bottom(double x) const { return height(x, layers_.continuum - layers_.overlap); } ///< of the overlap [m]
  double top(double x) const { return height(x, layers_.continuum); }                      ///< of the continuum [m]

  /// Behind this place [m] the continuum has a layer less; behind the cube for none.
  double step() const { return step_; }

  bool has_grain(const Vec3 &centre) const { return centre[2] >= bottom(centre[0]); }
  bool is_of_grains_alone(const Vec3 &centre) const { return centre[2] > top(centre[0]); }

  /// Height over the bottom of the cube, over that under a flat face; 1 where a step is.
  double stretch(double x) const;

  /// Weight of the grains at a place [m]: by the way through the overlap from its lower to its upper face, straight up
  /// or, at a step, to the nearest point of either.
  double weight_at(const Vec3 &place, coupling::WeightShape weight) const;

private:
  double height(double x, unsigned int layer) const;

  ElementLayers layers_;
  dem::Box cube_;
  std::vector<double> stretch_; // at the planes between columns
  double step_;
};

} // namespace bergamo::driver
