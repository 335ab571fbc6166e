#include "dem/force/wall_contacts.h"

#include "dem/contact/geometry.h"
#include "dem/core/parallel.h"
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

/// Rigid motion of a grain against a wall since the last step.
struct WallMotion
{
  Vec3 velocity, spin; ///< of the wall minus the grain's; the grain's
  double time_step;

  Vec3 displacement(const Vec3 &point) const { return time_step * (velocity - spin.cross(point)); }
};

/// A plane needs no search: its normal is the contact normal. Brings a grain that touches the plane to this step.
/// @return overlap; where it is not positive the state stays [m]
double locate(const Particles &p, const std::int32_t i, const PlaneWall &wall, const WallMotion &motion,
              ContactState<double> &s, const ContactLaw &law, const ContactParameters &parameters, Vec3 &force,
              ContactLosses &losses)
{
  const Vec3 normal = -wall.normal;
  const BodyPose pose = make_pose(p.shape[i], p.position[i], p.orientation[i]);
  const TangentFrame frame = tangent_frame(normal);
  const PlacedSupport<double> g = support(pose, normal, frame);
  const double overlap = g.height - wall.normal.dot(p.position[i] - wall.point);
  if (!(overlap > 0.))
    return overlap;

  const double old_overlap = s.overlap;
  s.spin += 0.5 * motion.time_step * motion.spin.dot(s.normal);
  const ContactState<double> before = s;
  const CurvatureBounds<double> bounds = curvature_bounds(pose.shape, parameters.curvature_bound);
  take_geometry(s, normal, overlap, relative_curvature(frame, g.radii, bounds), law.elastic);
  s.radius = p.bounding_radius[i];
  s.budget = motion_budget(parameters, s.radius, overlap, g.radii.norm());
  s.point = g.arm - 0.5 * overlap * normal;
  s.weight = p.weight[i];
  s.reduced_mass = p.mass[i]; // the wall is infinitely heavy
  losses.curvature += curvature_work(before, s, old_overlap);
  force = advance_contact(s, law, old_overlap, motion.displacement(s.point), motion.time_step, losses);
  return overlap;
}

/// Follows a touching contact along the motion. @return false if it must be located anew; then the state stays
bool follow(ContactState<double> &s, const WallMotion &motion, const ContactLaw &law, Vec3 &force,
            ContactLosses &losses)
{
  const Vec3 displacement = motion.displacement(s.point);
  const double overlap = s.overlap - s.normal.dot(displacement);
  const double budget = s.budget - displacement.norm() - motion.time_step * s.radius * motion.spin.norm();
  if (budget < 0. || overlap <= 0.)
    return false;
  const double old_overlap = s.overlap;
  s.overlap = overlap;
  s.budget = budget;
  s.spin += 0.5 * motion.time_step * motion.spin.dot(s.normal);
  force = advance_contact(s, law, old_overlap, displacement, motion.time_step, losses);
  return true;
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
      fresh.state.push_back(old == known.end() ? ContactState<double>::begin() : state[old->second]);
      fresh.rest_until.push_back(old == known.end() ? no_rest : rest_until[old->second]);
      if (old != known.end())
        known.erase(old);
    }
    fresh.row[i + 1] = static_cast<std::int32_t>(fresh.wall.size());
  }
  for (const auto &[key, k] : known)
  {
    fresh.losses += release(state[k]);
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
      losses += release(state[k]);
      wall[k] = -1; // no wall has this number: the next renewal drops the contact
    }
    else if (wall[k] > index)
      --wall[k];
  }
}

void WallContacts::compute(const Particles &p, std::vector<PlaneWall> &walls, const ContactLaw &law,
                           const ContactParameters &parameters, const double time_step)
{
  constexpr std::size_t chunk_size = 64; // contacts whose losses are summed together, whatever the threads
  struct Chunk
  {
    ContactLosses losses;
    std::int64_t n_searches = 0;
  };
  std::vector<Chunk> chunks((size() + chunk_size - 1) / chunk_size);
  const auto step = [&](const std::size_t k, Chunk &chunk)
  {
    const std::int32_t i = particle[k];
    const PlaneWall &plane = walls[wall[k]];
    const bool was_touching = is_touching(k);
    if (!was_touching && p.motion[i] + plane.motion < rest_until[k])
      return;

    ContactState<double> &s = state[k];
    const WallMotion motion{plane.velocity - p.velocity[i], p.angular_velocity[i], time_step};
    Vec3 force = Vec3::Zero();
    if (!was_touching || !follow(s, motion, law, force, chunk.losses))
    {
      ++chunk.n_searches;
      const double overlap = locate(p, i, plane, motion, s, law, parameters, force, chunk.losses);
      if (!(overlap > 0.))
      {
        if (was_touching)
          chunk.losses += separate(s, s.normal, motion.displacement(s.point));
        s = ContactState<double>::begin();
        rest_until[k] = p.motion[i] + plane.motion - overlap;
      }
    }
    resultant[k] = {s.point.cross(force), force, Vec3::Zero()};
  };
  parallel_ranges(chunks.size(), 1,
                  [&](const std::size_t, const std::size_t begin, const std::size_t end)
                  {
                    for (std::size_t c = begin; c < end; ++c)
                      for (std::size_t k = c * chunk_size; k < std::min((c + 1) * chunk_size, size()); ++k)
                        step(k, chunks[c]);
                  });
  for (const Chunk &chunk : chunks)
  {
    losses += chunk.losses;
    n_searches += chunk.n_searches;
  }

  std::vector<Vec3> old_force;
  for (PlaneWall &w : walls)
    old_force.push_back(std::exchange(w.force, Vec3::Zero()));
  for (std::size_t k = 0; k < size(); ++k)
    walls[wall[k]].force -= resultant[k].force;
  for (std::size_t w = 0; w < walls.size(); ++w)
    walls[w].work -= 0.5 * time_step * (old_force[w] + walls[w].force).dot(walls[w].velocity);
}

void WallContacts::refresh()
{
  for (ContactState<double> &s : state)
    s.budget = -1.;
}

ContactEnergy WallContacts::total_energy() const
{
  ContactEnergy sum;
  for (const ContactState<double> &s : state)
  {
    const ContactEnergy e = stored_energy(s);
    sum.normal += e.normal;
    sum.tangential += e.tangential;
  }
  return sum;
}

} // namespace bergamo::dem
