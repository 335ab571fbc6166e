#include "dem/force/wall_contacts.h"

#include "dem/neighbour/cell_grid.h"

#include <algorithm>
#include <limits>
#include <map>
#include <utility>

namespace bergamo::dem
{
namespace
{

constexpr double no_rest = -std::numeric_limits<double>::infinity();

/// A plane needs no search: its normal is the contact normal.
void locate(const Particles &p, const std::int32_t i, const PlaneWall &wall, ContactState &s, double &rest_until,
            const ContactLaw &law, const ContactParameters &parameters)
{
  const Vec3 normal = -wall.normal;
  const GlobalSupport g = support(make_pose(p.shape[i], p.position[i], p.orientation[i]), normal);
  const double overlap = g.height - wall.normal.dot(p.position[i] - wall.point);
  if (overlap > 0.)
  {
    const CurvatureBounds bounds = curvature_bounds(p.shape[i], parameters.curvature_bound);
    take_geometry(s, normal, overlap, relative_curvature(normal, g.hessian, bounds), law.elastic);
    s.motion_budget = motion_budget(parameters, p.bounding_radius[i], overlap, g.hessian.norm());
    s.point = g.arm - 0.5 * overlap * normal;
    s.weight = p.weight[i];
    s.reduced_mass = p.mass[i]; // the wall is infinitely heavy
    rest_until = no_rest;
  }
  else
  {
    s.overlap = overlap;
    rest_until = p.motion[i] + wall.motion - overlap;
  }
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
    for (std::size_t w = 0; w < walls.size(); ++w)
    {
      const double distance = walls[w].normal.dot(particles.position[i] - walls[w].point);
      if (distance >= particles.bounding_radius[i] + range)
        continue;
      fresh.particle.push_back(static_cast<std::int32_t>(i));
      fresh.wall.push_back(static_cast<std::int32_t>(w));
      const auto old = known.find({static_cast<std::int32_t>(i), static_cast<std::int32_t>(w)});
      fresh.state.push_back(old == known.end() ? ContactState{} : state[old->second]);
      fresh.rest_until.push_back(old == known.end() ? no_rest : rest_until[old->second]);
      if (old != known.end())
        known.erase(old);
    }
    fresh.row[i + 1] = static_cast<std::int32_t>(fresh.wall.size());
  }
  for (const auto &[key, k] : known)
  {
    release(state[k]);
    fresh.losses.take(state[k]);
  }
  fresh.resultant.assign(fresh.size(), {});
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
    {
      release(state[k]);
      losses.take(state[k]);
      wall[k] = -1; // no wall has this number: the next renewal drops the contact
    }
    else if (wall[k] > index)
      --wall[k];
  }
}

void WallContacts::compute(const Particles &p, std::vector<PlaneWall> &walls, const ContactLaw &law,
                           const ContactParameters &parameters, const double time_step)
{
  std::int64_t searches = 0;
#pragma omp parallel for schedule(static) reduction(+ : searches)
  for (std::size_t k = 0; k < size(); ++k)
  {
    const std::int32_t i = particle[k];
    const PlaneWall &plane = walls[wall[k]];
    if (p.motion[i] + plane.motion < rest_until[k])
      continue;

    const Vec3 &omega = p.angular_velocity[i];
    const ContactMotion motion{time_step * p.bounding_radius[i] * omega.norm(), 0.5 * time_step * omega};
    const auto displacement_at = [&](const ContactState &s) -> Vec3
    { return time_step * (plane.velocity - p.velocity[i] - omega.cross(s.point)); };
    const auto locate_wall = [&](ContactState &s)
    {
      ++searches;
      locate(p, i, plane, s, rest_until[k], law, parameters);
    };
    ContactState &s = state[k];
    const Vec3 force = step_contact(s, law, motion, time_step, displacement_at, locate_wall);
    resultant[k] = {force, s.point.cross(force), Vec3::Zero()};
  }
  n_searches += searches;

  std::vector<Vec3> old_force;
  for (PlaneWall &w : walls)
    old_force.push_back(std::exchange(w.force, Vec3::Zero()));
  for (std::size_t k = 0; k < size(); ++k)
    walls[wall[k]].force -= resultant[k].force;
  for (std::size_t w = 0; w < walls.size(); ++w)
    walls[w].work -= 0.5 * time_step * (old_force[w] + walls[w].force).dot(walls[w].velocity);
}

} // namespace bergamo::dem
