#include "dem/force/wall_contacts.h"

#include "dem/contact/geometry.h"
#include "dem/force/follow.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace bergamo::dem
{
namespace
{

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double no_rest = -infinity;

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
  take_geometry(s, normal, l.overlap, relative_curvature(frame, principal_radii(pose, normal, g.radii), bounds),
                law.elastic);
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
  row.resize(particles.size() + 1, 0); // none has candidates at first
  WallContacts fresh;
  fresh.losses = losses;
  fresh.n_searches = n_searches;
  fresh.row.assign(particles.size() + 1, 0);
  for (std::size_t i = 0; i < particles.size(); ++i)
  {
    const auto grain = static_cast<std::int32_t>(i);
    std::int32_t old = row[i]; // candidates of a grain are sorted by their walls
    const auto leave_until = [&](const std::int32_t plane)
    {
      for (; old < row[i + 1] && wall[old] != plane; ++old)
        if (is_touching(old))
          fresh.losses += release(state(old));
    };
    const auto take = [&](const std::int32_t plane)
    {
      const auto candidate = static_cast<std::int32_t>(fresh.size());
      fresh.particle.push_back(grain);
      fresh.wall.push_back(plane);
      fresh.slot.push_back(apart);
      fresh.rest_until.push_back(no_rest);
      if (std::find(wall.begin() + old, wall.begin() + row[i + 1], plane) == wall.begin() + row[i + 1])
        return;
      leave_until(plane);
      fresh.rest_until.back() = rest_until[old];
      if (is_touching(old))
        fresh.slot.back() = fresh.touching.add({candidate, grain, plane}, state(old));
      ++old;
    };
    for (std::size_t w = 0; w < walls.size() && !particles.is_fixed(i); ++w)
      if (walls[w].normal.dot(particles.position[i] - walls[w].point) < particles.bounding_radius[i] + range)
        take(static_cast<std::int32_t>(w));
    constexpr std::int32_t none = -2;
    leave_until(none);
    fresh.row[i + 1] = static_cast<std::int32_t>(fresh.wall.size());
  }
  *this = std::move(fresh);
}

void WallContacts::reorder(const std::vector<std::int32_t> &order)
{
  if (row.empty())
    return;
  std::vector<std::int32_t> new_row{0}, new_particle, new_wall, new_slot;
  std::vector<double> new_rest;
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    for (auto k = row[order[i]]; k < row[order[i] + 1]; ++k)
    {
      new_particle.push_back(static_cast<std::int32_t>(i));
      new_wall.push_back(wall[k]);
      new_slot.push_back(slot[k]);
      new_rest.push_back(rest_until[k]);
    }
    new_row.push_back(static_cast<std::int32_t>(new_wall.size()));
  }
  row = std::move(new_row);
  particle = std::move(new_particle);
  wall = std::move(new_wall);
  slot = std::move(new_slot);
  rest_until = std::move(new_rest);
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

math::Mask<Pack> WallContacts::follow_block(const std::size_t block, const Particles &p,
                                            const std::vector<PlaneWall> &walls, const ContactLaw &law,
                                            const double time_step, Losses<Pack> &lost)
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
  loads.add(block, followed.force, state.point.cross(followed.force), Vector3<Pack>(0., 0., 0.));
  return followed.is_due;
}

/// Candidates apart that may touch by now.
Collected<std::int32_t> WallContacts::screen(const Particles &p, const std::vector<PlaneWall> &walls) const
{
  Collected<std::int32_t> candidates;
  parallel_ranges(size(), 512,
                  [&](const std::size_t part, const std::size_t begin, const std::size_t end)
                  {
                    for (std::size_t k = begin; k < end; ++k)
                      if (!(p.motion[particle[k]] + walls[wall[k]].motion < rest_until[k]))
                        candidates.of(part).push_back(static_cast<std::int32_t>(k));
                  });
  return candidates;
}

void WallContacts::compute(const Particles &p, std::vector<PlaneWall> &walls, const ContactLaw &law,
                           const ContactParameters &parameters, const double time_step)
{
  list_bodies(p.size(), walls.size());
  const auto due = follow_all(touching, loads, losses,
                              [&](const std::size_t block, Losses<Pack> &lost)
                              { return follow_block(block, p, walls, law, time_step, lost); });
  std::vector<Located> located;
  due.for_each([&](const std::int32_t s) { located.push_back({touching.pair[s], 0., touching.get(s), {}}); });
  screen(p, walls).for_each(
      [&](const std::int32_t k) {
        located.push_back({k, 0., ContactState<double>::begin(), {}});
      });

  constexpr std::size_t chunk_size = 16; // whose losses are summed together, whatever the threads
  std::vector<ContactLosses> chunk_losses((located.size() + chunk_size - 1) / chunk_size);
  parallel_ranges(chunk_losses.size(), 1,
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
      touching.set(slot[k], l.state);
    else if (l.overlap > 0.)
    {
      slot[k] = touching.add({k, i, wall[k]}, l.state, k > 0 ? slot[k - 1] : apart);
      loads.take(slot[k], i, body_of(wall[k], p.size()));
      rest_until[k] = infinity;
    }
    else
    {
      if (is_touching(k))
      {
        losses +=
            separate(l.state, l.state.normal, motion_of(p, i, walls[wall[k]], time_step).displacement(l.state.point));
        touching.remove(slot[k]);
        slot[k] = apart;
      }
      rest_until[k] = p.motion[i] + walls[wall[k]].motion - l.overlap;
    }
  }
  list_bodies(p.size(), walls.size());
  for (const Located &l : located)
    if (l.overlap > 0.)
      loads.add(slot[l.candidate], l.resultant);

  for (std::size_t w = 0; w < walls.size(); ++w)
  {
    BodyLoad load;
    loads.add_load(body_of(w, p.size()), load);
    const Vec3 old_force = std::exchange(walls[w].force, load.force.head<3>());
    walls[w].work -= 0.5 * time_step * (old_force + walls[w].force).dot(walls[w].velocity);
  }
}

void WallContacts::list_bodies(const std::size_t n_grains, const std::size_t n_walls)
{
  if (loads.is_current())
    return;
  std::vector<std::int32_t> wall_body;
  for (const std::int32_t w : touching.second)
    wall_body.push_back(body_of(w, n_grains));
  loads.list_bodies(touching.first, wall_body, n_grains + n_walls);
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
