#include "fe_dealii/boundary/surface_load.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_q.h>

#include <cmath>

namespace bergamo::fe
{

SurfaceLoad::SurfaceLoad(Surface surface, const std::span<const std::array<double, 3>> position)
    : surface_(std::move(surface))
{
  for (const unsigned int node : surface_.nodes)
    position_.push_back(position[node]);
  const dealii::FE_Q<2> element(surface_.degree);
  const std::vector<unsigned int> place = element.get_poly_space_numbering_inverse();
  const dealii::QGauss<2> quadrature(surface_.degree + 1);
  for (unsigned int q = 0; q < quadrature.size(); ++q)
  {
    Point point{};
    point.weight = quadrature.weight(q);
    for (int node = 0; node < surface_.nodes_per_face(); ++node)
    {
      point.value[node] = element.shape_value(place[node], quadrature.point(q));
      point.slope_1[node] = element.shape_grad(place[node], quadrature.point(q))[0];
      point.slope_2[node] = element.shape_grad(place[node], quadrature.point(q))[1];
    }
    points_.push_back(point);
  }
}

/// Of a face's node. @param displacement of the body, or null at rest
double SurfaceLoad::position(const std::size_t face, const int node, const int component,
                             const double *displacement) const
{
  const std::size_t place = face * surface_.nodes_per_face() + node;
  const std::size_t dof = 3 * std::size_t(surface_.nodes[place]) + component;
  return position_[place][component] + (displacement ? displacement[dof] : 0);
}

/// Normal times the area that belongs to a point of quadrature. @param displacement of the body, or null at rest
SurfaceLoad::Vector SurfaceLoad::area_vector(const std::size_t face, const Point &point,
                                             const double *displacement) const
{
  Vector along_1{}, along_2{};
  for (int node = 0; node < surface_.nodes_per_face(); ++node)
  {
    for (int i = 0; i < 3; ++i)
    {
      const double x = position(face, node, i, displacement);
      along_1[i] += point.slope_1[node] * x;
      along_2[i] += point.slope_2[node] * x;
    }
  }
  Vector area;
  for (int i = 0; i < 3; ++i)
    area[i] =
        point.weight * (along_1[(i + 1) % 3] * along_2[(i + 2) % 3] - along_1[(i + 2) % 3] * along_2[(i + 1) % 3]);
  return area;
}

void SurfaceLoad::add_traction(const std::array<double, 3> &traction, const std::span<double> force) const
{
  for (std::size_t face = 0; face < surface_.size(); ++face)
    for (const Point &point : points_)
    {
      const Vector a = area_vector(face, point, nullptr);
      const double area = std::sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
      for (int node = 0; node < surface_.nodes_per_face(); ++node)
        for (int i = 0; i < 3; ++i)
          force[3 * std::size_t(surface_.face(face)[node]) + i] += point.value[node] * area * traction[i];
    }
}

void SurfaceLoad::add_pressure(const double pressure, const std::span<const double> displacement,
                               const std::span<double> force) const
{
  for (std::size_t face = 0; face < surface_.size(); ++face)
    for (const Point &point : points_)
    {
      const Vector area = area_vector(face, point, displacement.data());
      for (int node = 0; node < surface_.nodes_per_face(); ++node)
        for (int i = 0; i < 3; ++i)
          force[3 * std::size_t(surface_.face(face)[node]) + i] -= pressure * point.value[node] * area[i];
    }
}

double SurfaceLoad::reference_area() const
{
  double sum = 0;
  for (std::size_t face = 0; face < surface_.size(); ++face)
    for (const Point &point : points_)
    {
      const Vector a = area_vector(face, point, nullptr);
      sum += std::sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
    }
  return sum;
}

NodalArea SurfaceLoad::nodal_area(const std::size_t face, const int node) const
{
  NodalArea result;
  for (const Point &point : points_)
  {
    const Vector a = area_vector(face, point, nullptr);
    const double area = std::sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
    const double part = point.value[node] / area;
    result.area += point.value[node] * area;
    for (int i = 0; i < 3; ++i)
    {
      result.normals[i] += part * a[i] * a[i];
      result.normals[3 + i] += part * a[i] * a[(i + 1) % 3];
    }
  }
  return result;
}

double SurfaceLoad::volume(const std::span<const double> displacement) const
{
  double sum = 0;
  for (std::size_t face = 0; face < surface_.size(); ++face)
    for (const Point &point : points_)
    {
      const Vector area = area_vector(face, point, displacement.data());
      for (int node = 0; node < surface_.nodes_per_face(); ++node)
        for (int i = 0; i < 3; ++i)
          sum += point.value[node] * position(face, node, i, displacement.data()) * area[i] / 3;
    }
  return sum;
}

} // namespace bergamo::fe
