#include "fe_dealii/element/membrane.h"

#include <cmath>

namespace bergamo::fe::membrane
{
namespace
{

using Vector = std::array<double, 3>;

double dot(const Vector &a, const Vector &b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Vector cross(const Vector &a, const Vector &b)
{
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Vector unit(Vector a)
{
  const double length = std::sqrt(dot(a, a));
  for (double &x : a)
    x /= length;
  return a;
}

const double gauss[2] = {0.5 - 0.5 / std::sqrt(3.), 0.5 + 0.5 / std::sqrt(3.)}; // points of the unit interval

} // namespace

double shape_value(const int node, const int point)
{
  const double x = gauss[point % 2], y = gauss[point / 2];
  return (node % 2 == 0 ? 1 - x : x) * (node / 2 == 0 ? 1 - y : y);
}

Geometry reference_geometry(const std::array<Vector, n_nodes> &nodes, const double thickness)
{
  const auto diagonals = [&](const int a, const int b, const int c, const int d)
  {
    Vector one, other;
    for (int i = 0; i < 3; ++i)
    {
      one[i] = nodes[b][i] - nodes[a][i];
      other[i] = nodes[d][i] - nodes[c][i];
    }
    return cross(one, other);
  };
  const Vector middle_normal = diagonals(0, 3, 1, 2);
  Geometry geometry{};
  for (int point = 0; point < n_points; ++point)
  {
    const double x = gauss[point % 2], y = gauss[point / 2];
    const double slope_x[n_nodes] = {y - 1, 1 - y, -y, y}, slope_y[n_nodes] = {x - 1, -x, 1 - x, x};
    Vector along_x{}, along_y{};
    for (int node = 0; node < n_nodes; ++node)
      for (int i = 0; i < 3; ++i)
      {
        along_x[i] += slope_x[node] * nodes[node][i];
        along_y[i] += slope_y[node] * nodes[node][i];
      }
    const Vector normal = cross(along_x, along_y);
    const double area = std::sqrt(dot(normal, normal));
    geometry.volume[point] = 0.25 * thickness * (dot(normal, middle_normal) > 0 ? area : -area);
    if (!(geometry.volume[point] > 0))
      continue;
    const Vector e1 = unit(along_x), e2 = unit(cross(normal, e1));
    // Rows of the Jacobian in the local frame: along_x = (a, 0), along_y = (b, d).
    const double a = dot(along_x, e1), b = dot(along_y, e1), d = dot(along_y, e2);
    for (int i = 0; i < 3; ++i)
    {
      geometry.direction[0][i][point] = e1[i];
      geometry.direction[1][i][point] = e2[i];
    }
    for (int node = 0; node < n_nodes; ++node)
    {
      geometry.gradient[0][node][point] = slope_x[node] / a;
      geometry.gradient[1][node][point] = (slope_y[node] - slope_x[node] * b / a) / d;
    }
  }
  return geometry;
}

} // namespace bergamo::fe::membrane
