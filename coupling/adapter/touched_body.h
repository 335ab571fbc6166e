#pragma once

#include "coupling/model/mover.h"
#include "dem/state/surface.h"

#include <cstddef>
#include <span>

namespace bergamo::coupling
{

/// A contact as its body feels it: a spring at a point.
struct ContactSpring
{
  dem::FeatureOfSurface feature;
  Vec3 point;       ///< [m]
  double stiffness; ///< bound in any direction [N/m]
};

/// A body that moves by itself, with a surface of triangles that grains touch; see SurfaceContact.
class TouchedBody
{
public:
  virtual ~TouchedBody() = default;

  virtual const Mover &mover() const = 0;
  virtual std::size_t n_corners() const = 0; ///< of the triangles: nodes of the surface
  virtual bool is_rigid() const = 0;         ///< whether the corners keep their distances

  /// @param[out] place of each corner at present [m]
  virtual void find_places(std::span<Vec3> place) const = 0;

  /// Adds the forces on the surface's nodes to those on the body, with the same sum, moment and work.
  virtual void add_forces(const dem::Surface &surface) = 0;

  /// Bounds the squares of the frequencies at which springs between the body and places at rest make it vibrate, by
  /// its inertia alone [1/s^2].
  virtual double largest_square(const dem::Surface &surface, std::span<const ContactSpring> springs) const = 0;
};

} // namespace bergamo::coupling
