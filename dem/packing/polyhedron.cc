#include "dem/packing/polyhedron.h"

#include "dem/core/error.h"
#include "dem/core/tangent_frame.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace bergamo::dem
{
namespace
{

constexpr double resolution = 1e-9; // of the largest coordinate

/// Corners of all planes, three by three, that lie in all half-spaces.
std::vector<Vec3> corners(const std::span<const HalfSpace> planes)
{
  double size = 0.;
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < planes.size(); ++i)
    for (std::size_t j = i + 1; j < planes.size(); ++j)
      for (std::size_t k = j + 1; k < planes.size(); ++k)
      {
        const Vec3 jk = planes[j].normal.cross(planes[k].normal), ki = planes[k].normal.cross(planes[i].normal),
                   ij = planes[i].normal.cross(planes[j].normal);
        const double det = planes[i].normal.dot(jk);
        if (std::abs(det) < 1e-9)
          continue;
        const Vec3 x = (planes[i].offset * jk + planes[j].offset * ki + planes[k].offset * ij) / det;
        points.push_back(x);
      }
  for (const HalfSpace &plane : planes)
    size = std::max(size, std::abs(plane.offset));
  std::vector<Vec3> inside;
  for (const Vec3 &x : points)
  {
    const double near = resolution * std::max(size, x.norm());
    const bool is_inside = std::all_of(planes.begin(), planes.end(),
                                       [&](const HalfSpace &p) { return p.normal.dot(x) <= p.offset + near; });
    const bool is_new =
        std::none_of(inside.begin(), inside.end(), [&](const Vec3 &y) { return (x - y).norm() <= 10. * near; });
    if (is_inside && is_new)
      inside.push_back(x);
  }
  return inside;
}

/// Area of the polygon of the corners on a plane.
double face_area(const HalfSpace &plane, const std::vector<Vec3> &vertices)
{
  std::vector<Vec3> face;
  Vec3 middle = Vec3::Zero();
  for (const Vec3 &x : vertices)
    if (std::abs(plane.normal.dot(x) - plane.offset) <= 100. * resolution * std::max(std::abs(plane.offset), x.norm()))
    {
      face.push_back(x);
      middle += x;
    }
  if (face.size() < 3)
    return 0.;
  middle /= static_cast<double>(face.size());
  const auto frame = tangent_frame(plane.normal);
  const auto angle = [&](const Vec3 &x)
  { return std::atan2(frame.col(1).dot(x - middle), frame.col(0).dot(x - middle)); };
  std::sort(face.begin(), face.end(), [&](const Vec3 &x, const Vec3 &y) { return angle(x) < angle(y); });
  Vec3 twice = Vec3::Zero();
  for (std::size_t k = 0; k < face.size(); ++k)
    twice += (face[k] - middle).cross(face[(k + 1) % face.size()] - middle);
  return 0.5 * twice.norm();
}

} // namespace

Polyhedron enclosed_by(const std::span<const HalfSpace> planes)
{
  Polyhedron body;
  body.vertices = corners(planes);
  const auto fail = [&](const std::string &what)
  {
    throw ConfigError("the " + std::to_string(planes.size()) + " planes of the packing's space " + what +
                      ": each must be given with its normal away from the grains, and all together must close a body");
  };
  if (body.vertices.size() < 4)
    fail("enclose no volume");
  body.low = body.high = body.vertices[0];
  for (const Vec3 &x : body.vertices)
  {
    body.low = body.low.cwiseMin(x);
    body.high = body.high.cwiseMax(x);
  }
  // The faces of a closed body balance; those of an open one leave the normal of the opening.
  Vec3 balance = Vec3::Zero();
  double surface = 0.;
  const Vec3 centre = 0.5 * (body.low + body.high);
  std::vector<const HalfSpace *> faces;
  for (const HalfSpace &plane : planes)
  {
    const bool is_repeated =
        std::any_of(faces.begin(), faces.end(),
                    [&](const HalfSpace *p)
                    {
                      return (p->normal - plane.normal).norm() < 1e-9 &&
                             std::abs(p->offset - plane.offset) <= 1e-9 * (body.high - body.low).norm();
                    });
    if (is_repeated)
      continue;
    faces.push_back(&plane);
    const double area = face_area(plane, body.vertices);
    balance += area * plane.normal;
    surface += area;
    body.volume += area * (plane.offset - plane.normal.dot(centre)) / 3.;
  }
  if (!(balance.norm() <= 1e-6 * surface))
    fail("leave the body open");
  if (!(body.volume > 1e-9 * (body.high - body.low).prod()))
    fail("enclose no volume");
  return body;
}

} // namespace bergamo::dem
