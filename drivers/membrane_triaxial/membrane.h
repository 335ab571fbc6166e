#pragma once

#include "drivers/membrane_triaxial/parameters.h"
#include "fe_dealii/boundary/face_triangles.h"
#include "fe_dealii/boundary/surface_load.h"
#include "fe_dealii/membrane_body.h"

#include <memory>
#include <span>
#include <vector>

namespace bergamo::driver
{

/// An upright prism around the z axis, as high above the origin as below it.
struct Prism
{
  double radius = 0.; ///< of its edges [m]
  double height = 0.; ///< [m]
};

/// Rims of the membrane, as boundaries of its mesh.
enum MembraneRim : unsigned int
{
  lower_rim = 1,
  upper_rim = 2
};

/// A membrane free of stress on the sides of a prism; its faces look inwards, at the grains. The same mesh whatever the
/// prism.
std::unique_ptr<fe::MembraneBody> make_membrane(const MembraneParameters &parameters, const Prism &prism);

/// Its faces as grains touch them: two triangles an element, corners at the nodes.
fe::FaceTriangles faces_of(const fe::MembraneBody &membrane);

/// What is measured of a membrane whose rims stay on two plates.
class MembraneShape
{
public:
  /// @param membrane must outlive it
  MembraneShape(const MembraneParameters &parameters, const fe::MembraneBody &membrane, const Prism &prism);

  /// Volume between membrane and plates [m³]: the divergence theorem over the bilinear faces, whose integral the points
  /// of quadrature have to rounding, and over both plates. @param height between these [m]
  double volume(double height) const;

  /// Mean distances of the nodes from the axis, ring by ring from below [m].
  std::vector<double> radii() const;

private:
  const fe::MembraneBody &body;
  fe::SurfaceLoad faces;
  std::vector<std::size_t> ring_of; // by node
  std::size_t n_rings;
  double rim_area; // [m²]
};

} // namespace bergamo::driver
