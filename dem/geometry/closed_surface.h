#pragma once

#include "dem/geometry/moments.h"
#include "dem/geometry/surface_contact.h"

#include <cstddef>
#include <cstdint>

namespace bergamo::dem
{

/// Where a surface that ought to be closed is not.
struct Holes
{
  std::size_t n_holes = 0;                   ///< loops of edges with a face on one side alone
  std::size_t n_edges = 0;                   ///< of these edges
  std::int32_t edge = SurfaceTopology::none; ///< the first of them
};

Holes holes_of(const SurfaceTopology &topology);

/// Integrals over what a closed surface encloses, negative where its normals point inwards, so that cavities count off:
/// each triangle and a point make a tetrahedron, signed by the side that its normal points to, whose integrals have
/// closed forms (Mirtich 1996, Tonon 2004). @param surface closed; @param origin from which x, y and z count [m]
Moments enclosed_moments(const SurfaceView &surface, const Vec3 &origin);

/// A body of uniform density 1, in global axes.
struct EnclosedBody
{
  double volume; ///< > 0 [m^3]
  Vec3 centre;   ///< of mass [m]
  Mat3 inertia;  ///< about the centre [m^5]
};

/// The body within a closed surface whose normals point outwards.
/// Throws ConfigError for a surface with holes, or one whose normals point inwards, as that of a vessel.
EnclosedBody enclosed_body(const SurfaceView &surface);

} // namespace bergamo::dem
