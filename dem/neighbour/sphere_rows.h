#pragma once

#include "dem/neighbour/bounding_spheres.h"
#include "dem/state/periodic_cell.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace bergamo::dem
{

/// Spheres of like size (size_classes.h).
struct SphereClass
{
  double range = 0.;                             ///< of its largest sphere [m]
  Vec3 width = Vec3::Zero();                     ///< of its rows in y and z [m], at least the range; x is not used
  Vec3 n_rows = Vec3::Zero();                    ///< in the directions of a periodic cell; infinite elsewhere
  std::int32_t begin_layers = 0, end_layers = 0; ///< in SphereRows::layers
};

/// Spheres of a class whose z lies in [number, number + 1) widths.
struct SphereLayer
{
  double number;                     ///< whole, but a double, for which no place is too far
  std::int32_t begin_rows, end_rows; ///< in SphereRows::rows
};

/// Row along x of a layer's spheres whose y lies in [number, number + 1) widths.
struct SphereRow
{
  double number;
  std::int32_t begin, end; ///< of its spheres in the order of rows
};

/// Spheres in an order, each number in an array of its own, for packs.
struct SphereArrays
{
  std::vector<std::int32_t> sphere;    ///< index
  std::vector<double> place;           ///< x, in the cell if it is periodic along x [m]
  std::vector<double> x, y, z, radius; ///< as given [m]

  /// As many numbers as fill a pack stand behind the last sphere.
  void resize(std::size_t n_spheres);

  /// Copies sphere s of others to place k.
  void put(const std::size_t k, const SphereArrays &others, const std::size_t s)
  {
    sphere[k] = others.sphere[s];
    place[k] = others.place[s];
    x[k] = others.x[s];
    y[k] = others.y[s];
    z[k] = others.z[s];
    radius[k] = others.radius[s];
  }
};

/// Spheres sorted by size and place: classes of size from the largest to the smallest, the layers of each by z, the
/// rows of a layer by y, the spheres of a row by x. Nothing is kept for space without spheres, so that time and memory
/// follow from the number of spheres alone, wherever they lie and however much their sizes differ.
struct SphereRows
{
  /// @param verlet_distance [m], >= 0; @param cell if periodic, spheres outside are taken at their image in it
  SphereRows(const BoundingSpheres &spheres, double verlet_distance, const PeriodicCell &cell);

  std::vector<SphereClass> classes;
  std::vector<SphereLayer> layers;
  std::vector<SphereRow> rows;
  SphereArrays spheres; ///< in the order of rows
};

/// The image of a place that lies in the cell; the place itself in directions in which nothing repeats itself [m].
Vec3 place_in(const PeriodicCell &cell, const Vec3 &x);

/// Along one direction [m].
struct Interval
{
  double low, high;
};

/// Numbers of the rows or layers of a class that meet an interval or an image of it, each once.
struct RowNumbers
{
  /// @param direction 1: rows, by y; 2: layers, by z
  RowNumbers(const SphereClass &size, int direction, const Interval &interval);

  int n_stretches = 1;
  Interval stretch[2]; ///< first and last number
};

} // namespace bergamo::dem
