#pragma once

#include "drivers/rubber_block/parameters.h"
#include "fe_dealii/boundary/face_triangles.h"
#include "fe_dealii/explicit_body.h"

#include <memory>

namespace bergamo::driver
{

/// Boundaries of the block's mesh.
enum BlockBoundary : unsigned int
{
  block_sides = 0, ///< all but the top, the groove's faces too
  block_top = 1
};

/// The block, free of stress. @param corner its least coordinates [m]; @param gravity [m/s²]
std::unique_ptr<fe::ExplicitBody> make_block(const BlockParameters &parameters, const Vec3 &corner, double gravity);

/// Triangles on all of its faces, those of the sides first, face after face.
fe::FaceTriangles block_faces(const fe::ExplicitBody &block, const BlockParameters &parameters);

} // namespace bergamo::driver
