#include "fe_dealii/conditions/rigid_motion.h"

#include "dem/core/error.h"

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>
#include <deal.II/physics/transformations.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace bergamo::fe
{
namespace
{

using Vector = RigidMotion::Vector;
using Matrix = dealii::Tensor<2, 3>;
using Column = dealii::Tensor<1, 3>;

Column column(const Vector &v)
{
  Column result;
  for (int i = 0; i < 3; ++i)
    result[i] = v[i];
  return result;
}

Vector vector(const Column &v)
{
  return {v[0], v[1], v[2]};
}

Matrix matrix(const double (&m)[3][3])
{
  Matrix result;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      result[i][j] = m[i][j];
  return result;
}

void store(const Matrix &m, double (&result)[3][3])
{
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      result[i][j] = m[i][j];
}

/// Rotation by the vector's length [rad] about it.
Matrix rotation(const Column &turn)
{
  const double angle = turn.norm();
  Matrix identity;
  for (int i = 0; i < 3; ++i)
    identity[i][i] = 1;
  if (angle == 0)
    return identity;
  return dealii::Physics::Transformations::Rotations::rotation_matrix_3d(dealii::Point<3>(Column(turn / angle)), angle);
}

} // namespace

void RigidInertia::add_point(const double m, const std::array<double, 3> &arm)
{
  const double square = arm[0] * arm[0] + arm[1] * arm[1] + arm[2] * arm[2];
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      inertia[i][j] += m * ((i == j) * square - arm[i] * arm[j]);
}

/// Spin of an angular momentum in an orientation; the guided components of the spin are theirs, and the momentum
/// becomes that of the spin: guides exert moments about their own axes alone.
Vector RigidMotion::spin_at(const double (&orientation)[3][3], Vector &momentum) const
{
  const Matrix r = matrix(orientation), of_body = r * matrix(inertia_.inertia) * transpose(r);
  Matrix system;
  Column right;
  for (int i = 0; i < 3; ++i)
  {
    const bool is_guided = guide.angular_velocity[i].has_value();
    right[i] = is_guided ? *guide.angular_velocity[i] : momentum[i];
    for (int j = 0; j < 3; ++j)
      system[i][j] = is_guided ? i == j : of_body[i][j];
  }
  // Against what it would be with equal inertias, so that units do not matter.
  double scale = 1;
  for (int i = 0; i < 3; ++i)
    if (!guide.angular_velocity[i])
      scale *= std::max({of_body[0][0], of_body[1][1], of_body[2][2]});
  constexpr double singular = 1e-12;
  if (!(determinant(system) > singular * scale))
    throw ConfigError(
        "rigid body: its inertia is singular; give it one, guide its rotation, or take nodes that are not "
        "on a line");
  const Column spin = invert(system) * right;
  momentum = vector(of_body * spin);
  return vector(spin);
}

void RigidMotion::kick(const Vector &force, const Vector &moment, const double time, const double step)
{
  for (int i = 0; i < 3; ++i)
    if (!std::isfinite(force[i] + moment[i]))
    {
      std::ostringstream message;
      message << "rigid body: the forces on it at (" << motion_.centre[0] << ", " << motion_.centre[1] << ", "
              << motion_.centre[2] << ") m are no finite numbers; look for what is none in loads and motions";
      throw RunError(message.str());
    }
  Vector momentum = motion_.angular_momentum;
  for (int i = 0; i < 3; ++i)
  {
    if (!guide.velocity[i] && !(inertia_.mass > 0))
      throw ConfigError("rigid body: it has no mass; give it one, or guide its motion");
    const double free = motion_.velocity[i] + (guide.velocity[i] ? 0 : time / inertia_.mass * force[i]);
    const double next = guide.velocity[i].value_or(free);
    guide_force_[i] = guide.velocity[i] ? inertia_.mass * (next - motion_.velocity[i]) / time - force[i] : 0;
    motion_.velocity[i] = next;
    momentum[i] += time * moment[i];
  }
  // The spin of the half step from the orientation of the half step: second order.
  Vector predicted = momentum;
  const Column first = column(spin_at(motion_.rotation, predicted));
  double halfway[3][3];
  store(rotation(0.5 * step * first) * matrix(motion_.rotation), halfway);
  motion_.angular_momentum = momentum;
  motion_.spin = spin_at(halfway, motion_.angular_momentum);
  for (int i = 0; i < 3; ++i)
    guide_moment_[i] = guide.angular_velocity[i] ? (motion_.angular_momentum[i] - momentum[i]) / time : 0;
}

void RigidMotion::prescribe(const Vector &velocity, const Vector &angular_velocity, const double step)
{
  motion_.velocity = velocity;
  motion_.spin = angular_velocity;
  const Matrix halfway = rotation(0.5 * step * column(motion_.spin)) * matrix(motion_.rotation);
  motion_.angular_momentum = vector(halfway * matrix(inertia_.inertia) * transpose(halfway) * column(motion_.spin));
}

void RigidMotion::drift(const double step)
{
  store(rotation(step * column(motion_.spin)) * matrix(motion_.rotation), motion_.rotation);
  for (int i = 0; i < 3; ++i)
    motion_.centre[i] += step * motion_.velocity[i];
}

RigidMotion::Vector RigidMotion::place_of(const Vector &arm) const
{
  return vector(column(motion_.centre) + matrix(motion_.rotation) * column(arm));
}

RigidMotion::Vector RigidMotion::velocity_of(const Vector &arm) const
{
  return vector(column(motion_.velocity) +
                dealii::cross_product_3d(column(motion_.spin), matrix(motion_.rotation) * column(arm)));
}

double RigidMotion::angle() const
{
  const double cosine = 0.5 * (trace(matrix(motion_.rotation)) - 1);
  return std::acos(std::clamp(cosine, -1., 1.));
}

} // namespace bergamo::fe
