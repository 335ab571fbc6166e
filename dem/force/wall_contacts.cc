#include "dem/force/wall_contacts.h"

#include "dem/contact/geometry.h"
#include "dem/force/follow.h"
#include "dem/neighbour/cell_grid.h"

#include <algorithm>
#include <limits>
#include <map>
#include <utility>

namespace bergamo::dem
{
namespace
{

constexpr std::size_t group_size = 64; // candidates that are left alone together
constexpr double no_rest = -std::numeric_limits<double>::infinity();

/// Rigid motion of a grain against a wall since the last step, as PairMotion.
template <class Real>
struct WallMotion
{
  Vector3<Real> velocity; ///< of the wall minus the grain's [m/s]
  Vector3<Real> spin;     ///< of the grain [1/s]
  double time_step;

  /// @param point contact point minus the grain's centre [m]
  Vector3<Real> displacement(const Vector3<Real> &point) const
  {
    return (velocity - spin.cross(point)) * Real(time_step);
  }
  Real turn_about(const Vector3<Real> &axis) const { return axis.dot(spin) * Real(0.5 * time_step); }
  Real bound(const Vector3<Real> &displacement, const Real &radius) const
  {
    const auto size = [](const Vector3<Real> &v) -> Real
    { return math::abs(v[0]) + math::abs(v[1]) + math::abs(v[2]); };
    return size(displacement) + radius * size(spin) * Real(time_step);
  }
};

WallMotion<double> motion_of(const Particles &p, const std::int32_t i, const PlaneWall &wall, const double time_step)
{
  return {wall.velocity - p.velocity[i], p.angular_velocity[i], time_step};
}

/// Outcome of looking where a grain stands to a plane.
struct Located
{
  std::int32_t candidate;
  double overlap;             ///< [m]
  ContactState<double> state; ///< as last step left it; this step's where the overlap is positive
  Resultant resultant;
};

/// A plane needs no search: its normal is the contact normal.
/// @param[in,out] l with the state of last step, or ContactState::begin()
void locate(const Particles &p, const std::int32_t i, const PlaneWall &wall, const ContactLaw &law,
            const ContactParameters &parameters, const double time_step, Located &l, ContactLosses &losses)
{
  const Vec3 normal = -wall.normal;
  const BodyPose pose = make_pose(p.shape[i], p.position[i], p.orientation[i]);
  const TangentFrame frame = tangent_frame(normal);
  const PlacedSupport<double> g = support(pose, normal, frame);
  l.overlap = g.height - wall.normal.dot(p.position[i] - wall.point);
  if (!(l.overlap > 0.))
    return;

  ContactState<double> &s = l.state;
  const WallMotion<double> motion = motion_of(p, i, wall, time_step);
  const double old_overlap = s.overlap;
  s.spin += motion.turn_about(s.normal);
  const ContactState<double> before = s;
  const CurvatureBounds<double> bounds = curvature_bounds(pose.shape, parameters.curvature_bound);
  take_geometry(s, normal, l.overlap, relative_curvature(frame, g.radii, bounds), law.elastic);
  s.radius = p.bounding_radius[i];
  s.budget = motion_budget(parameters, s.radius, l.overlap, g.radii.norm());
  s.point = g.arm - 0.5 * l.overlap * normal;
  s.weight = p.weight[i];
  s.reduced_mass = p.mass[i]; // the wall is infinitely heavy
  losses.curvature += curvature_work(before, s, old_overlap);
  const Vec3 force = advance_contact(s, law, old_overlap, motion.displacement(s.point), time_step, losses);
  l.resultant = {force, s.point.cross(force), Vec3::Zero()};
}

} // namespace

void WallContacts::renew(const Particles &particles, const std::vector<PlaneWall> &walls, const double range)
{
  std::map<std::pair<std::int32_t, std::int32_t>, std::size_t> known;
  for (std::size_t k = 0; k < size(); ++k)
    known.emplace(std::pair(particle[k], wall[k]), k);

  WallContacts fresh;
  fresh.losses = losses;
  fresh.n_searches = n_searches;
  fresh.row.assign(particles.size() + 1, 0);
  for (std::size_t i = 0; i < particles.size(); ++i)
  {
    for (std::size_t w = 0; w < walls.size() && !particles.is_fixed(i); ++w)
    {
      const double distance = walls[w].normal.dot(particles.position[i] - walls[w].point);
      if (distance >= particles.bounding_radius[i] + range)
        continue;
      const auto grain = static_cast<std::int32_t>(i), plane = static_cast<std::int32_t>(w);
      const auto candidate = static_cast<std::int32_t>(fresh.size());
      fresh.particle.push_back(grain);
      fresh.wall.push_back(plane);
      fresh.slot.push_back(apart);
      fresh.rest_until.push_back(no_rest);
      const auto old = known.find({grain, plane});
      if (old == known.end())
        continue;
      fresh.rest_until.back() = rest_until[old->second];
      if (is_touching(old->second))
        fresh.slot.back() =
            fresh.touching.add(candidate, grain, plane, state(old->second), touching.resultant[slot[old->second]]);
      known.erase(old);
    }
    fresh.row[i + 1] = static_cast<std::int32_t>(fresh.wall.size());
  }
  for (const auto &[key, k] : known)
    if (is_touching(k))
      fresh.losses += release(state(k));
  fresh.group_rest_until.assign((fresh.size() + group_size - 1) / group_size, no_rest);
  *this = std::move(fresh);
}

void WallContacts::reorder(const std::vector<std::int32_t> &order)
{
  const std::vector<std::int32_t> new_index = inverse_order(order);
  for (std::int32_t &i : particle)
    i = new_index[i];
}

void WallContacts::remove_wall(const std::int32_t index)
{
  for (std::size_t k = 0; k < size(); ++k)
  {
    if (wall[k] == index)
      wall[k] = -1; // no wall has this number: the next renewal drops the contact
    else if (wall[k] > index)
      --wall[k];
  }
}

void WallContacts::compute(const Particles &p, std::vector<PlaneWall> &walls, const ContactLaw &law,
                           const ContactParameters &parameters, const double time_step)
{
  const auto due = follow_all(
      touching, losses,
      [&](const std::size_t block, Losses<Pack> &lost)
      {
        const auto grain = [&](const int lane) { return touching.first[block * pack_width + lane]; };
        const auto plane = [&](const int lane) { return touching.second[block * pack_width + lane]; };
        const WallMotion<Pack> motion{
            math::gather_vectors<Pack>([&](const int lane) -> const Vec3 & { return walls[plane(lane)].velocity; }) -
                math::gather_vectors<Pack>([&](const int lane) -> const Vec3 & { return p.velocity[grain(lane)]; }),
            math::gather_vectors<Pack>([&](const int lane) -> const Vec3 & { return p.angular_velocity[grain(lane)]; }),
            time_step};
        ContactState<Pack> &state = touching.blocks[block];
        const Followed<Pack> followed = follow(state, motion, law, lost);
        const Vector3<Pack> nothing(0., 0., 0.);
        store_resultants<Pack>(followed.force, state.point.cross(followed.force), nothing,
                               [&](const int lane) -> Resultant &
                               { return touching.resultant[block * pack_width + lane]; });
        return followed.is_due;
      });

  std::vector<Located> located;
  due.for_each([&](const std::int32_t s) { located.push_back({touching.pair[s], 0., touching.get(s), {}}); });
  double largest_motion = p.largest_motion;
  for (const PlaneWall &plane : walls)
    largest_motion += plane.motion;
  for (std::size_t group = 0; group < group_rest_until.size(); ++group)
  {
    if (largest_motion < group_rest_until[group])
      continue;
    double slack = std::numeric_limits<double>::infinity();
    for (std::size_t k = group * group_size; k < std::min((group + 1) * group_size, size()); ++k)
    {
      if (is_touching(k))
        continue;
      const double motion = p.motion[particle[k]] + walls[wall[k]].motion;
      if (!(motion < rest_until[k]))
        located.push_back({static_cast<std::int32_t>(k), 0., ContactState<double>::begin(), {}});
      slack = std::min(slack, std::max(rest_until[k] - motion, 0.));
    }
    group_rest_until[group] = largest_motion + slack;
  }

  constexpr std::size_t chunk_size = 16; // whose losses are summed together, whatever the threads
  std::vector<ContactLosses> chunk_losses((located.size() + chunk_size - 1) / chunk_size);
  parallel_ranges(chunk_losses.size(), 4,
                  [&](const std::size_t, const std::size_t begin, const std::size_t end)
                  {
                    for (std::size_t n = begin * chunk_size; n < std::min(end * chunk_size, located.size()); ++n)
                    {
                      const std::int32_t k = located[n].candidate;
                      locate(p, particle[k], walls[wall[k]], law, parameters, time_step, located[n],
                             chunk_losses[n / chunk_size]);
                    }
                  });
  for (const ContactLosses &lost : chunk_losses)
    losses += lost;
  n_searches += static_cast<std::int64_t>(located.size());

  for (const Located &l : located)
  {
    const std::int32_t k = l.candidate, i = particle[k];
    if (l.overlap > 0. && is_touching(k))
    {
      touching.set(slot[k], l.state);
      touching.resultant[slot[k]] = l.resultant;
    }
    else if (l.overlap > 0.)
      slot[k] = touching.add(k, i, wall[k], l.state, l.resultant);
    else
    {
      rest_until[k] = p.motion[i] + walls[wall[k]].motion - l.overlap;
      if (!is_touching(k))
        continue;
      losses +=
          separate(l.state, l.state.normal, motion_of(p, i, walls[wall[k]], time_step).displacement(l.state.point));
      touching.remove(slot[k]);
      slot[k] = apart;
      group_rest_until[k / group_size] = no_rest;
    }
  }

  std::vector<Vec3> old_force;
  for (PlaneWall &w : walls)
    old_force.push_back(std::exchange(w.force, Vec3::Zero()));
  for (std::size_t s = 0; s < touching.n_slots(); ++s)
    if (touching.pair[s] != touching.free_slot)
      walls[touching.second[s]].force -= touching.resultant[s].force.head<3>();
  for (std::size_t w = 0; w < walls.size(); ++w)
    walls[w].work -= 0.5 * time_step * (old_force[w] + walls[w].force).dot(walls[w].velocity);
}

void WallContacts::add_resultants(const std::int32_t i, GrainLoad &load) const
{
  for (auto k = row[i]; k < row[i + 1]; ++k)
    if (is_touching(k))
      load.add(touching.resultant[slot[k]], 0);
}

void WallContacts::refresh()
{
  for (ContactState<Pack> &block : touching.blocks)
    block.budget = math::select(block.weight > 0., Pack(-1.), block.budget);
}

ContactEnergy WallContacts::total_energy() const
{
  ContactEnergy sum;
  for (std::size_t k = 0; k < size(); ++k)
    if (is_touching(k))
    {
      const ContactEnergy e = stored_energy(state(k));
      sum.normal += e.normal;
      sum.tangential += e.tangential;
    }
  return sum;
}

} // namespace bergamo::dem
