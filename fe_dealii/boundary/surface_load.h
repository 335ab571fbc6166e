#pragma once

#include "fe_dealii/boundary/surface.h"

#include <array>
#include <span>
#include <vector>

namespace bergamo::fe
{

/// A node's part of a face in the reference configuration.
struct NodalArea
{
  double area = 0;                 ///< ∫ N dA [m²]
  std::array<double, 6> normals{}; ///< ∫ N n⊗n dA, xx yy zz xy yz zx [m²]
};

/// Forces on the nodes of a surface from what acts on its area. Displacements and forces are arrays of the whole body,
/// 3*node + component.
class SurfaceLoad
{
public:
  /// @param position of all nodes in the reference configuration [m]
  SurfaceLoad(Surface surface, std::span<const std::array<double, 3>> position);

  /// Adds a dead load: forces per reference area, in a fixed direction [Pa].
  void add_traction(const std::array<double, 3> &traction, std::span<double> force) const;

  /// Adds a pressure that follows the surface: force −p n per present area [Pa].
  void add_pressure(double pressure, std::span<const double> displacement, std::span<double> force) const;

  double reference_area() const; ///< [m²]

  /// @param node 0 .. nodes_per_face() − 1 of the face
  NodalArea nodal_area(std::size_t face, int node) const;

  /// Volume inside a closed surface, that of the cone from the origin to an open one [m³]. Of a closed surface the
  /// forces of a unit pressure are minus its derivative by the displacement, to rounding.
  double volume(std::span<const double> displacement) const;
  const Surface &surface() const { return surface_; }

private:
  struct Point // of quadrature
  {
    double weight;
    std::array<double, 9> value, slope_1, slope_2; // of the shape functions
  };
  using Vector = std::array<double, 3>;
  Vector area_vector(std::size_t face, const Point &point, const double *displacement) const;
  double position(std::size_t face, int node, int component, const double *displacement) const;

  Surface surface_;
  std::vector<Vector> position_; // of the surface's nodes, in its order
  std::vector<Point> points_;
};

} // namespace bergamo::fe
