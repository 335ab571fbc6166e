#include "dem/motion/stable_step.h"

#include "dem/geometry/superquadric.h"

#include <cmath>
#include <limits>

namespace bergamo::dem
{
namespace
{

/// Generalised motion of all bodies: translations and rotations.
struct Motion
{
  std::vector<Vec3> translation, rotation;
};

/// Stiffness and damping of one touching contact, without the weight.
struct Coefficients
{
  double normal, damping, tangential_major, tangential_minor;
};

Coefficients coefficients(const ContactView &s, const ContactLaw &law)
{
  const double root = std::sqrt(s.overlap), normal = 1.5 * s.stiffness.normal * root;
  return {normal, normal_damping(law, normal, s.reduced_mass), root * s.stiffness.tangential_major,
          root * s.stiffness.tangential_minor};
}

/// Forces K x dt^2/4 + C x dt/2 of all contacts on a motion x, divided by mass and inertia.
class Operator
{
public:
  Operator(const Particles &p, const std::span<const TouchingContact> contacts, const std::span<const ContactLaw> laws)
      : p(p), contacts(contacts), laws(laws)
  {
  }

  /// @return Rayleigh parts x.Kx and x.Cx for x.Mx = 1 beside M^-1 (..) x
  Motion apply(const Motion &x, const double stiffness_factor, const double damping_factor, double &stiff,
               double &damped) const
  {
    Motion y{std::vector<Vec3>(p.size(), Vec3::Zero()), std::vector<Vec3>(p.size(), Vec3::Zero())};
    stiff = damped = 0.;
    const auto force_of = [&](const ContactView &s, const ContactLaw &law, const Vec3 &d) -> Vec3
    {
      const Coefficients k = coefficients(s, law);
      const double along = s.normal.dot(d);
      const Vec3 minor_axis = s.normal.cross(s.major_axis);
      const Vec3 elastic =
          s.weight * (k.normal * along * s.normal + k.tangential_major * s.major_axis.dot(d) * s.major_axis +
                      k.tangential_minor * minor_axis.dot(d) * minor_axis);
      const Vec3 viscous = s.weight * k.damping * along * s.normal;
      stiff += elastic.dot(d);
      damped += viscous.dot(d);
      return stiffness_factor * elastic + damping_factor * viscous;
    };
    for (const TouchingContact &contact : contacts)
    {
      const auto i = contact.first, j = contact.second;
      const ContactView &s = contact.state;
      const ContactLaw &law = laws[contact.law];
      if (j == no_grain)
      {
        const Vec3 f = force_of(s, law, x.translation[i] + x.rotation[i].cross(s.point));
        y.translation[i] += f;
        y.rotation[i] += s.point.cross(f);
        continue;
      }
      const Vec3 half_line = 0.5 * contact.branch;
      const Vec3 arm1 = s.point + half_line, arm2 = s.point - half_line;
      const Vec3 f =
          force_of(s, law, x.translation[i] + x.rotation[i].cross(arm1) - x.translation[j] - x.rotation[j].cross(arm2));
      y.translation[i] += f;
      y.translation[j] -= f;
      y.rotation[i] += arm1.cross(f);
      y.rotation[j] -= arm2.cross(f);
    }
    for (std::size_t i = 0; i < p.size(); ++i)
    {
      y.translation[i] /= p.weight[i] * p.mass[i];
      y.rotation[i] = angular_acceleration(i, y.rotation[i]);
    }
    return y;
  }

  double mass_norm(const Motion &x) const
  {
    double sum = 0.;
    for (std::size_t i = 0; i < p.size(); ++i)
    {
      if (p.is_fixed(i))
        continue;
      const Vec3 body = p.orientation[i].conjugate() * x.rotation[i];
      sum += p.weight[i] * (p.mass[i] * x.translation[i].squaredNorm() + body.dot(p.inertia[i].cwiseProduct(body)));
    }
    return std::sqrt(sum);
  }

private:
  Vec3 angular_acceleration(const std::size_t i, const Vec3 &torque) const
  {
    const Vec3 body = p.orientation[i].conjugate() * torque;
    return p.orientation[i] * Vec3(body.cwiseQuotient(p.inertia[i]) / p.weight[i]);
  }

  const Particles &p;
  std::span<const TouchingContact> contacts;
  std::span<const ContactLaw> laws;
};

void scale(Motion &x, const double factor)
{
  for (Vec3 &v : x.translation)
    v *= factor;
  for (Vec3 &v : x.rotation)
    v *= factor;
}

} // namespace

double stable_time_step(const Particles &particles, const std::span<const TouchingContact> contacts,
                        const std::span<const ContactLaw> laws, const double guess)
{
  constexpr int n_rounds = 3, n_iterations = 40;
  const Operator op(particles, contacts, laws);

  // A fixed start without symmetry and without zeros, so that no mode is missed and the result repeats.
  Motion start{std::vector<Vec3>(particles.size()), std::vector<Vec3>(particles.size())};
  for (std::size_t i = 0; i < particles.size(); ++i)
  {
    const double phase = 0.7 * static_cast<double>(particles.id[i]);
    start.translation[i] = Vec3(std::sin(phase + 3.), std::sin(1.3 * phase + 1.), std::sin(1.7 * phase + 2.));
    start.rotation[i] = Vec3(std::sin(1.9 * phase + 4.), std::sin(2.3 * phase + 1.), std::sin(2.9 * phase + 2.)) /
                        particles.bounding_radius[i];
  }
  double step = guess;
  for (int round = 0; round < n_rounds; ++round)
  {
    Motion x = start; // anew: another mode may limit another step
    double stiff = 0., damped = 0.;
    for (int i = 0; i < n_iterations; ++i)
    {
      const double norm = op.mass_norm(x);
      if (!(norm > 0.))
        return std::numeric_limits<double>::infinity();
      scale(x, 1. / norm);
      x = op.apply(x, 0.25 * step * step, 0.5 * step, stiff, damped);
    }
    if (!(stiff > 0.))
      return std::numeric_limits<double>::infinity();
    // 1 = stiff step^2 / 4 + damped step / 2 for the mode found
    step = (std::sqrt(damped * damped + 4. * stiff) - damped) / stiff;
  }
  return step;
}

double stable_step_of_two_spheres(const double radius, const Material &material, const double relative_overlap)
{
  const double mass = material.density * volume(Superquadric{Vec3::Constant(radius), 1., 1.});
  const double modulus = 0.5 * material.young_modulus / (1. - std::pow(material.poisson_ratio, 2));
  const double stiffness = 2. * modulus * std::sqrt(0.5 * radius * relative_overlap * radius); // Hertz
  return 2. * std::sqrt(0.5 * mass / stiffness);
}

} // namespace bergamo::dem
