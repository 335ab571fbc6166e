#include "dem/motion/leapfrog.h"
#include "dem/core/pack_vectors.h"

#include "dem/core/parallel.h"
#include "dem/motion/rotation.h"

#include <algorithm>
#include <limits>
#include <vector>

namespace bergamo::dem
{
namespace
{

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Grains from `begin`, as many as there are lanes; lanes beyond `end` repeat the last grain and are not stored.
struct Lanes
{
  std::size_t begin, end;

  std::size_t operator()(const int lane) const { return std::min(begin + lane, end - 1); }
  int size() const { return static_cast<int>(std::min<std::size_t>(pack_width, end - begin)); }
};

Pack load(const std::vector<double> &values, const Lanes &grains)
{
  if (grains.size() == pack_width)
    return math::load(&values[grains.begin]);
  return math::generate<Pack>([&](const int lane) { return values[grains(lane)]; });
}

Vector3<Pack> load(const std::vector<Vec3> &values, const Lanes &grains)
{
  if (grains.size() == pack_width)
    return math::load_vectors<Pack>(&values[grains.begin]);
  return math::gather_vectors<Pack>([&](const int lane) -> const Vec3 & { return values[grains(lane)]; });
}

Orientation<Pack> load(const std::vector<Quaternion> &values, const Lanes &grains)
{
  if (grains.size() == pack_width)
  {
    const auto [x, y, z, w] = math::load_fours<Pack>(values[grains.begin].coeffs().data());
    return {x, y, z, w};
  }
  const auto number = [&](const int d)
  { return math::generate<Pack>([&](const int lane) { return values[grains(lane)].coeffs()[d]; }); };
  return {number(0), number(1), number(2), number(3)};
}

void store(std::vector<Vec3> &values, const Lanes &grains, const Vector3<Pack> &packed)
{
  if (grains.size() == pack_width)
    math::store_vectors<Pack>(packed, &values[grains.begin]);
  else
    for (int lane = 0; lane < grains.size(); ++lane)
      values[grains.begin + lane] = math::lane<Pack>(packed, lane);
}

void store(std::vector<Quaternion> &values, const Lanes &grains, const Orientation<Pack> &q)
{
  if (grains.size() == pack_width)
    math::scatter_vectors<Pack>(
        Vector3<Pack>(q.x, q.y, q.z), [&](const int lane) -> Vec4 & { return values[grains.begin + lane].coeffs(); },
        q.w);
  else
    for (int lane = 0; lane < grains.size(); ++lane)
      values[grains.begin + lane] =
          Quaternion(math::lane(q.w, lane), math::lane(q.x, lane), math::lane(q.y, lane), math::lane(q.z, lane));
}

void add(std::vector<double> &values, const Lanes &grains, const Pack &packed)
{
  if (grains.size() == pack_width)
    math::store(math::load(&values[grains.begin]) + packed, &values[grains.begin]);
  else
    for (int lane = 0; lane < grains.size(); ++lane)
      values[grains.begin + lane] += math::lane(packed, lane);
}

/// @param path of the centres [m]; @param turn [rad]
void add_motion_of_parts(Particles &p, const Lanes &grains, const Pack &path, const Pack &turn)
{
  for (int lane = 0; lane < grains.size(); ++lane)
    for (auto k = p.first_part[grains.begin + lane]; k < p.first_part[grains.begin + lane + 1]; ++k)
      p.parts.motion[k] += math::lane(path, lane) + math::lane(turn, lane) * p.parts.reach[k];
}

struct Step
{
  const AccelerationField &field;
  double kick, drift; // [s]
};

/// @return whether all new states are finite, else none is stored; `largest` grows to the largest motion of a grain
bool advance_lanes(Particles &p, const Lanes &grains, const Step &step, Pack &largest)
{
  const AccelerationField &field = step.field;
  const double dt = step.drift;
  const Pack weight = load(p.weight, grains), kick = step.kick / weight;
  const Pack mass = load(p.mass, grains), acceleration = kick / mass;
  Vector3<Pack> force = load(p.force, grains);
  if (!p.external_force.empty())
    force += load(p.external_force, grains);
  Vector3<Pack> torque = load(p.torque, grains);
  if (!p.external_torque.empty())
    torque += load(p.external_torque, grains);
  const Pack free = math::select(mass < infinity, Pack(1.), Pack(0.)); // 0 for a fixed grain
  const Vector3<Pack> old_position = load(p.position, grains);
  Vector3<Pack> field_kick;
  for (int d = 0; d < 3; ++d)
    field_kick[d] = free * (step.kick * field.constant[d] + step.kick * field.gradient[d] * old_position[d]);
  const Vector3<Pack> velocity = load(p.velocity, grains) + force * acceleration + field_kick;
  const Vector3<Pack> position = old_position + velocity * Pack(dt);
  const Vector3<Pack> momentum = load(p.angular_momentum, grains) + torque * (kick * free);

  const Orientation<Pack> old = load(p.orientation, grains);
  const Vector3<Pack> spin = mean_angular_velocity(old, load(p.inertia, grains), momentum, dt);
  const Orientation<Pack> orientation = turned(old, Vector3<Pack>(spin * Pack(dt)));

  const Pack turn = dt * spin.norm(), motion = dt * velocity.norm() + turn * load(p.bounding_radius, grains);
  if (math::any(!(motion + position.squaredNorm() + orientation.w < infinity)))
    return false;
  largest = math::max(largest, motion);
  store(p.velocity, grains, velocity);
  store(p.drift_velocity, grains, velocity);
  store(p.position, grains, position);
  store(p.angular_momentum, grains, momentum);
  store(p.angular_velocity, grains, spin);
  store(p.orientation, grains, orientation);
  add(p.turned, grains, turn);
  if (p.has_clumps())
    add_motion_of_parts(p, grains, dt * velocity.norm(), turn);
  else
    add(p.parts.motion, grains, motion);
  return true;
}

} // namespace

bool advance(Particles &particles, const AccelerationField &field, const double kick, const double drift)
{
  struct Found
  {
    bool is_finite;
    double largest_motion;
  };
  Collected<Found> found;
  const std::size_t n = particles.size(), n_packs = (n + pack_width - 1) / pack_width;
  parallel_ranges(n_packs, 8,
                  [&](const std::size_t part, const std::size_t begin, const std::size_t end)
                  {
                    bool is_finite = true;
                    Pack largest(0.);
                    for (std::size_t pack = begin; pack < end; ++pack)
                      is_finite &= advance_lanes(particles, {pack * pack_width, n}, {field, kick, drift}, largest);
                    double most = 0.;
                    for (int lane = 0; lane < pack_width; ++lane)
                      most = std::max(most, math::lane(largest, lane));
                    found.of(part).push_back({is_finite, most});
                  });
  bool is_finite = true;
  double largest = 0.;
  found.for_each(
      [&](const Found &f)
      {
        is_finite = is_finite && f.is_finite;
        largest = std::max(largest, f.largest_motion);
      });
  particles.largest_motion += largest;
  return is_finite;
}

} // namespace bergamo::dem
