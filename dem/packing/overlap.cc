#include "dem/packing/overlap.h"

#include "dem/geometry/newton_search.h"

#include <cmath>

namespace bergamo::dem
{
namespace
{

/// Distance from the centre to the surface along a global direction, over the length of the direction.
double radial_share(const PlacedGrain &grain, const Vec3 &direction)
{
  const double f = inside_outside(grain.shape, grain.pose.rotation.transpose() * direction);
  return std::pow(f, -0.5 * grain.shape.eps2); // F(t X) = t^(2/eps2) F(X)
}

} // namespace

double inscribed_radius(const Superquadric &shape)
{
  return 1. / bounding_radius({shape.half_axes.cwiseInverse(), 2. - shape.eps1, 2. - shape.eps2});
}

bool are_apart(const PlacedGrain &first, const PlacedGrain &second, const Vec3 &centre_line)
{
  constexpr int max_evaluations = 60;
  const double square = centre_line.squaredNorm();
  const double far = first.bounding_radius + second.bounding_radius,
               near = first.inscribed_radius + second.inscribed_radius;
  if (square > far * far)
    return true;
  if (square <= near * near)
    return false;
  if (radial_share(first, centre_line) + radial_share(second, -centre_line) >= 1.)
    return false; // both hold a point of the centre line
  const BodyPose image{second.pose.shape, second.pose.rotation, first.pose.position + centre_line};
  NewtonSearch<double> search(first.pose, image, centre_line / std::sqrt(square));
  search.run(max_evaluations);
  return search.best.phi < 0.;
}

} // namespace bergamo::dem
