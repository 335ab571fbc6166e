#include "dem/geometry/clump_mass.h"

#include "dem/core/error.h"
#include "dem/geometry/moments.h"
#include "dem/geometry/orientation.h"
#include "dem/geometry/part_overlap.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace bergamo::dem
{
namespace
{

bool is_same(const ClumpPart &a, const ClumpPart &b)
{
  return a.shape.half_axes == b.shape.half_axes && a.shape.eps1 == b.shape.eps1 && a.shape.eps2 == b.shape.eps2 &&
         a.position == b.position &&
         (a.orientation.coeffs() == b.orientation.coeffs() || a.orientation.coeffs() == -b.orientation.coeffs());
}

/// What a part adds to the union of the larger ones.
struct Addition
{
  ClumpPart part;
  Moments shared = Moments::Zero(); ///< to be taken off, in the part's own coordinates
  double error = 0.;                ///< of these

  double scale() const { return part.shape.half_axes.prod(); } ///< of a volume in these coordinates [m^3]
};

/// The parts that add something, large ones first.
std::vector<Addition> additions_of(const ClumpShape &clump, const double tolerance)
{
  std::vector<std::size_t> order(clump.parts.size());
  std::iota(order.begin(), order.end(), 0);
  const auto size = [&](const std::size_t k) { return volume(clump.parts[k].shape); };
  std::stable_sort(order.begin(), order.end(),
                   [&](const std::size_t i, const std::size_t j) { return size(i) > size(j); });
  std::vector<Addition> additions;
  std::vector<ClumpPart> before;
  for (const std::size_t k : order)
  {
    ClumpPart part = clump.parts[k];
    part.orientation = unit_orientation(part.orientation);
    if (std::any_of(before.begin(), before.end(), [&](const ClumpPart &other) { return is_same(part, other); }))
      continue;
    std::vector<ClumpPart> near;
    for (const ClumpPart &other : before)
      if ((other.position - part.position).norm() < bounding_radius(other.shape) + bounding_radius(part.shape))
        near.push_back(other);
    const PartOverlap overlap = shared_moments(part, near, tolerance);
    if (overlap.is_whole)
      continue;
    before.push_back(part);
    additions.push_back({part, overlap.shared.value, overlap.shared.error});
  }
  return additions;
}

/// Integrals of 1, x and x x^T over the union, x from a point in the middle.
struct Sums
{
  double volume = 0.;
  Vec3 first = Vec3::Zero();
  Mat3 second = Mat3::Zero();
  double volume_error = 0., first_error = 0., second_error = 0.;

  void add(const Addition &addition, const Vec3 &origin)
  {
    const Superquadric &shape = addition.part.shape;
    const Vec3 arm = addition.part.position - origin, own = inertia_per_density(shape);
    const Mat3 turn = addition.part.orientation.toRotationMatrix();
    const Mat3 map = turn * shape.half_axes.asDiagonal(); // to coordinates from the part's centre
    const double scale = addition.scale(), shared = scale * addition.shared[0];
    // The moments of the whole part about its centre, then those of what is shared.
    const double v = dem::volume(shape) - shared;
    const Vec3 s = -(scale * (map * addition.shared.segment<3>(1).matrix()));
    const Vec3 diagonal = Vec3::Constant(0.5 * own.sum()) - own;
    const Mat3 m = turn * diagonal.asDiagonal() * turn.transpose() -
                   scale * (map * second_moments(addition.shared) * map.transpose());
    volume += v;
    first += v * arm + s;
    second += m + s * arm.transpose() + arm * s.transpose() + v * arm * arm.transpose();
    const double error = scale * addition.error, reach = arm.norm() + shape.half_axes.norm();
    volume_error += error;
    first_error += error * reach;
    second_error += error * reach * reach;
  }
};

/// Moments ascending, axes right-handed.
void set_principal(MassProperties &mass, const Mat3 &inertia)
{
  const Eigen::SelfAdjointEigenSolver<Mat3> solver(inertia);
  mass.inertia = solver.eigenvalues();
  Mat3 axes = solver.eigenvectors();
  for (int d = 0; d < 2; ++d)
  {
    int largest = 0;
    axes.col(d).cwiseAbs().maxCoeff(&largest);
    if (axes(largest, d) < 0.)
      axes.col(d) *= -1.;
  }
  axes.col(2) = axes.col(0).cross(axes.col(1));
  mass.orientation = Quaternion(axes).normalized();
}

MassProperties of_single(const ClumpPart &part)
{
  MassProperties mass;
  mass.volume = volume(part.shape);
  mass.centre = part.position;
  mass.inertia = inertia_per_density(part.shape);
  mass.orientation = part.orientation;
  return mass;
}

} // namespace

MassProperties mass_properties(const ClumpShape &clump, const double tolerance)
{
  clump.validate();
  require(tolerance >= 1e-10 && tolerance <= 1e-2, "tolerance of a clump's mass properties", tolerance,
          "in [1e-10, 1e-2]");
  const std::vector<Addition> additions = additions_of(clump, tolerance);
  if (additions.size() == 1)
    return of_single(additions[0].part);

  Vec3 origin = Vec3::Zero();
  for (const Addition &addition : additions)
    origin += addition.part.position / static_cast<double>(additions.size());
  Sums sums;
  for (const Addition &addition : additions)
    sums.add(addition, origin);
  MassProperties mass;
  const Vec3 centre = sums.first / sums.volume;
  mass.volume = sums.volume;
  mass.centre = origin + centre;
  set_principal(mass, inertia_of(sums.second - sums.volume * centre * centre.transpose()));
  mass.volume_error = sums.volume_error;
  mass.centre_error = (sums.first_error + centre.norm() * sums.volume_error) / sums.volume;
  mass.inertia_error =
      2. * (sums.second_error + 2. * centre.norm() * sums.first_error + centre.squaredNorm() * sums.volume_error);
  return mass;
}

ClumpShape in_principal_frame(const ClumpShape &clump, const MassProperties &mass)
{
  return in_frame(clump, mass.centre, mass.orientation);
}

} // namespace bergamo::dem
