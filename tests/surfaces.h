#pragma once

#include "dem/geometry/surface_contact.h"
#include "dem/packing/distribution.h"
#include "dem/simulation/simulation_parameters.h"

#include <cmath>
#include <numeric>
#include <random>
#include <vector>

namespace bergamo::dem::test
{

/// Soft grains, of one material with what they touch, under gravity.
inline SimulationParameters soft_grains(const double friction, const double damping)
{
  SimulationParameters p;
  p.grain() = p.wall() = {1e8, 0.3, 2650.};
  p.between_grains().friction = p.with_walls().friction = friction;
  p.set_damping(damping);
  p.gravity = Vec3(0., 0., -9.81);
  p.time_step = 2e-6;
  return p;
}

/// A surface with its nodes.
struct Surface
{
  std::vector<Vec3> node;
  SurfaceTopology topology;

  SurfaceView view() const { return {topology, node}; }
  std::vector<std::int32_t> all_faces() const
  {
    std::vector<std::int32_t> faces(topology.n_faces());
    std::iota(faces.begin(), faces.end(), 0);
    return faces;
  }
};

/// n x n squares of side 1 over [0, n] x [0, n], each cut along one of its diagonals, with heights of their own.
template <class Height>
Surface grid_surface(const int n, const Height &height, const double jitter, std::mt19937_64 &random)
{
  std::uniform_real_distribution<double> unit(-1., 1.);
  Surface s;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i)
    {
      const double x = i + jitter * unit(random), y = j + jitter * unit(random);
      s.node.emplace_back(x, y, height(x, y));
    }
  std::vector<Triangle> triangles;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i)
    {
      const std::int32_t a = j * (n + 1) + i, b = a + 1, c = b + n + 1, d = a + n + 1;
      if (unit(random) > 0.)
        triangles.insert(triangles.end(), {{a, b, c}, {a, c, d}});
      else
        triangles.insert(triangles.end(), {{a, b, d}, {b, c, d}});
    }
  s.topology = SurfaceTopology(triangles, s.node.size());
  return s;
}

/// Two triangles that meet along the y axis, each falling away from it by an angle; a valley if that is negative.
inline Surface ridge(const double slope)
{
  const double x = 10. * std::cos(slope), z = -10. * std::sin(slope);
  return {{Vec3(0., -10., 0.), Vec3(0., 10., 0.), Vec3(-x, 0., z), Vec3(x, 0., z)},
          SurfaceTopology({{0, 1, 2}, {1, 0, 3}}, 4)};
}

/// Closed cube [-1, 1]^3 of twelve triangles, normals outwards.
inline Surface cube()
{
  Surface s;
  for (int k = 0; k < 8; ++k)
    s.node.emplace_back(k & 1 ? 1. : -1., k & 2 ? 1. : -1., k & 4 ? 1. : -1.);
  std::vector<Triangle> t;
  const auto quad = [&](std::int32_t a, std::int32_t b, std::int32_t c, std::int32_t d) {
    t.insert(t.end(), {{a, b, c}, {a, c, d}});
  };
  quad(0, 2, 3, 1);
  quad(4, 5, 7, 6);
  quad(0, 1, 5, 4);
  quad(2, 6, 7, 3);
  quad(0, 4, 6, 2);
  quad(1, 3, 7, 5);
  s.topology = SurfaceTopology(t, 8);
  return s;
}

/// Of a size about 1, any shape that is not nearly a box or pointed.
inline Superquadric random_grain(std::mt19937_64 &random)
{
  std::uniform_real_distribution<double> size(0.5, 1.5), exponent(0.5, 1.3);
  Superquadric s;
  s.half_axes = Vec3(size(random), size(random), size(random));
  s.eps1 = exponent(random);
  s.eps2 = exponent(random);
  return s;
}

} // namespace bergamo::dem::test
