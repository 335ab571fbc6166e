#pragma once

#include "dem/core/types.h"
#include "dem/geometry/superquadric.h"

#include <cstdint>
#include <vector>

namespace bergamo::dem
{

/// Shapes on particles as a structure of arrays, in the order of the particles that carry them. What touches goes by
/// part, what moves goes by particle. A plain grain is one part at its particle's centre.
struct Parts
{
  std::vector<std::int32_t> particle; ///< that carries the part, ascending
  std::vector<Superquadric> shape;
  std::vector<std::int32_t> material;  ///< of the simulation's table
  std::vector<Vec3> place;             ///< of the part's centre in the particle's frame [m]
  std::vector<Quaternion> turn;        ///< the part's frame to the particle's
  std::vector<double> bounding_radius; ///< about the part's centre [m]
  std::vector<double> reach;           ///< of the part's surface from the particle's centre, at most [m]
  std::vector<double> swing;  ///< change of a part's height above its centre over a radian of turn, at most [m]
  std::vector<double> motion; ///< path that bounds the motion of any surface point since the start [m]

  std::size_t size() const { return shape.size(); }

  /// A sphere about the centre of its particle: its contacts follow from the centres alone.
  bool is_central_sphere(const std::size_t k) const { return shape[k].is_sphere() && place[k] == Vec3::Zero(); }

  /// Every array of the parts with its name: sorting, snapshot and hash follow from this list.
  template <class Self, class Visit>
  static void visit_fields(Self &self, Visit &&visit)
  {
    visit("particle", self.particle);
    visit("shape", self.shape);
    visit("material", self.material);
    visit("place", self.place);
    visit("turn", self.turn);
    visit("bounding_radius", self.bounding_radius);
    visit("reach", self.reach);
    visit("swing", self.swing);
    visit("motion", self.motion);
  }

  template <class Self, class Visit>
  static void visit_state(Self &self, Visit &visit)
  {
    visit_fields(self, visit);
  }
};

} // namespace bergamo::dem
