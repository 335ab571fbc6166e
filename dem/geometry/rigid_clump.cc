#include "dem/geometry/rigid_clump.h"

#include "dem/core/error.h"
#include "dem/geometry/clump_mass.h"
#include "dem/geometry/support.h"

#include <algorithm>
#include <cmath>

namespace bergamo::dem
{

Clump::Clump(const ClumpShape &shape, const double tolerance)
{
  const MassProperties mass = mass_properties(shape, tolerance);
  if (shape.parts.size() == 1)
  {
    *this = Clump(shape.parts[0].shape); // in its own frame, without the rounding of a turn to and fro
    return;
  }
  body = in_principal_frame(shape, mass);
  v = mass.volume;
  inertia = mass.inertia;
  radius = dem::bounding_radius(body);
}

Clump::Clump(const Superquadric &shape)
{
  shape.validate();
  body.parts.push_back({shape});
  v = dem::volume(shape);
  inertia = dem::inertia_per_density(shape);
  radius = dem::bounding_radius(shape);
}

Clump Clump::scaled(const double factor) const
{
  require(factor > 0. && std::isfinite(factor), "factor of a clump's size", factor, "positive");
  Clump other = *this;
  for (ClumpPart &part : other.body.parts)
  {
    part.shape.half_axes *= factor;
    part.position *= factor;
  }
  if (other.body.parts.size() == 1)
    return Clump(other.body.parts[0].shape);
  other.body.validate();
  const double square = factor * factor;
  other.v *= square * factor;
  other.inertia *= square * square * factor;
  other.radius = dem::bounding_radius(other.body);
  return other;
}

double caliper_width(const Clump &clump, const Vec3 &direction)
{
  double ahead = 0., behind = 0.;
  for (const ClumpPart &part : clump.parts())
  {
    const Vec3 n = part.orientation.conjugate() * direction;
    const double height = support(support_shape(part.shape), n[0], n[1], n[2]).h, // alike to both sides
        place = part.position.dot(direction);
    ahead = std::max(ahead, height + place);
    behind = std::max(behind, height - place);
  }
  return ahead + behind;
}

} // namespace bergamo::dem
