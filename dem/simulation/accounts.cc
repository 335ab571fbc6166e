#include "dem/simulation/accounts.h"

#include "dem/core/parallel.h"
#include "dem/motion/rotation.h"

#include <algorithm>

namespace bergamo::dem
{

void Accounts::reset(const double potential)
{
  removed_wall_work = exchanged = step_change = 0.;
  cell_work.sum = cell_work.half_kick = 0.;
  std::fill(external_work.begin(), external_work.end(), 0.);
  start_potential = potential;
}

void Accounts::book_external_work(const Particles &p, const double drift)
{
  const bool acts = !p.external_force.empty();
  if (!acts && last_external_force.empty())
    return;
  external_work.resize(p.size(), 0.);
  last_external_force.resize(p.size(), Vec3::Zero());
  parallel_for(p.size(),
               [&](const std::size_t i)
               {
                 const Vec3 external = acts ? p.external_force[i] : Vec3(Vec3::Zero());
                 external_work[i] += 0.5 * drift * (last_external_force[i] + external).dot(p.drift_velocity[i]);
                 last_external_force[i] = external;
               });
  if (!acts)
    last_external_force.clear();
}

double Accounts::external_work_on(const Particles &p, const std::size_t i, const double drift) const
{
  if (external_work.empty() || p.is_fixed(i))
    return 0.;
  if (p.external_force.empty() || last_external_force.empty())
    return external_work[i];
  return external_work[i] + 0.5 * drift * (last_external_force[i] + p.external_force[i]).dot(p.drift_velocity[i]);
}

void Accounts::make_room(const std::size_t n_particles)
{
  if (!external_work.empty())
    external_work.resize(n_particles, 0.);
  if (!last_external_force.empty())
    last_external_force.resize(n_particles, Vec3::Zero());
}

void Accounts::reorder(const std::vector<std::int32_t> &order)
{
  const auto take = [&](auto &values)
  {
    if (values.empty())
      return;
    auto sorted = values;
    sorted.clear();
    for (const std::int32_t old : order)
      sorted.push_back(values[old]);
    values = std::move(sorted);
  };
  take(external_work);
  take(last_external_force);
}

double gravity_potential(const Particles &p, const Vec3 &gravity)
{
  double sum = 0.;
  for (std::size_t i = 0; i < p.size(); ++i)
    if (!p.is_fixed(i))
      sum -= p.weight[i] * p.mass[i] * gravity.dot(p.position[i]);
  return sum;
}

namespace
{

/// Velocity, angular momentum and spin of a particle at the half step after.
struct HalfStepAfter
{
  Vec3 velocity, momentum, spin;

  HalfStepAfter(const Particles &p, const std::size_t i, const Vec3 &field_acceleration, const double kick)
  {
    Vec3 force = p.force[i], torque = p.torque[i];
    if (!p.external_force.empty())
      force += p.external_force[i];
    if (!p.external_torque.empty())
      torque += p.external_torque[i];
    velocity = p.velocity[i] + kick * (force / (p.weight[i] * p.mass[i]) + field_acceleration);
    momentum = p.angular_momentum[i] + kick / p.weight[i] * torque;
    spin = spin_of(p, i, momentum);
  }

  static Vec3 spin_of(const Particles &p, const std::size_t i, const Vec3 &momentum)
  {
    return angular_velocity(p.orientation[i].toRotationMatrix(), p.inertia[i], momentum);
  }
};

} // namespace

double kinetic_energy(const Particles &p, const std::size_t i, const Vec3 &field_acceleration, const StepLengths &steps)
{
  const HalfStepAfter next(p, i, field_acceleration, steps.next_kick);
  const double mass = p.weight[i] * p.mass[i], weight = p.weight[i];
  const Vec3 &v = p.velocity[i], &momentum = p.angular_momentum[i];
  const double at_step = 0.5 * mass * v.dot(next.velocity) + 0.5 * weight * momentum.dot(next.spin);
  const double skew = 0.5 * (0.5 - steps.share_before());
  if (skew == 0.)
    return at_step;
  const double before = mass * v.squaredNorm() + weight * momentum.dot(HalfStepAfter::spin_of(p, i, momentum)),
               after = mass * next.velocity.squaredNorm() + weight * next.momentum.dot(next.spin);
  return at_step + skew * (before - after);
}

double step_change_work(const Particles &p, const std::size_t i, const Vec3 &field_acceleration,
                        const StepLengths &steps)
{
  const HalfStepAfter next(p, i, field_acceleration, steps.next_kick);
  const Vec3 change = next.velocity - p.velocity[i], turn = next.momentum - p.angular_momentum[i];
  return (steps.share_before() - 0.5) * p.weight[i] *
         (p.mass[i] * change.squaredNorm() + turn.dot(HalfStepAfter::spin_of(p, i, turn)));
}

} // namespace bergamo::dem
