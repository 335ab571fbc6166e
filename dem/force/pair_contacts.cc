#include "dem/force/pair_contacts.h"

#include "dem/contact/common_normal.h"
#include "dem/neighbour/cell_grid.h"

#include <algorithm>
#include <limits>
#include <tuple>

namespace bergamo::dem
{
namespace
{

constexpr double no_rest = -std::numeric_limits<double>::infinity();

/// Share of the contact in the virtual work: interpolated along the line of centres, Wellmann (6.29), and held between
/// the weights of the particles where the contact lies beside that line.
double contact_weight(const double weight1, const double weight2, const Vec3 &centre_line, const Vec3 &arm1)
{
  if (weight1 == weight2)
    return weight1;
  const double fraction = std::clamp(centre_line.dot(arm1) / centre_line.squaredNorm(), 0., 1.);
  return weight1 + fraction * (weight2 - weight1);
}

/// The same contact seen with its bodies exchanged.
void exchange_bodies(ContactState &s)
{
  s.normal = -s.normal;
  s.tangential_force = -s.tangential_force;
  s.spin = -s.spin; // about the normal
}

/// Searches the contact at the present poses. A touching pair takes the geometry, a separated one a rest.
/// @return true if the search was decided
bool search(const Particles &p, const std::int32_t i, const std::int32_t j, ContactState &s, double &rest_until,
            const ContactLaw &law, const ContactParameters &parameters)
{
  const BodyPose body1 = make_pose(p.shape[i], p.position[i], p.orientation[i]);
  const BodyPose body2 = make_pose(p.shape[j], p.position[j], p.orientation[j]);
  const bool is_known = s.normal.squaredNorm() > 0.;
  const ContactGeometry g = is_known ? update_contact(body1, body2, s.normal) : find_contact(body1, body2);
  if (g.overlap > 0.)
  {
    const RelativeCurvature curvature =
        relative_curvature(g.normal, g.hessian1, curvature_bounds(p.shape[i], parameters.curvature_bound), g.hessian2,
                           curvature_bounds(p.shape[j], parameters.curvature_bound));
    take_geometry(s, g.normal, g.overlap, curvature, law.elastic);
    const Vec3 half_line = 0.5 * (p.position[j] - p.position[i]);
    s.motion_budget = motion_budget(parameters, std::min(p.bounding_radius[i], p.bounding_radius[j]), g.overlap,
                                    (g.hessian1 + g.hessian2).norm());
    s.point = 0.5 * (g.arm1 + g.arm2);
    s.weight = contact_weight(p.weight[i], p.weight[j], 2. * half_line, half_line + s.point);
    s.reduced_mass = p.mass[i] * p.mass[j] / (p.mass[i] + p.mass[j]);
    rest_until = no_rest;
  }
  else
  {
    s.normal = g.normal;
    s.overlap = g.overlap;
    rest_until = p.motion[i] + p.motion[j] - g.overlap;
  }
  return g.status != ContactStatus::undecided;
}

} // namespace

void PairContacts::renew(VerletList new_list, const Particles &particles)
{
  std::vector<ContactState> new_state(new_list.size());
  std::vector<double> new_rest(new_list.size(), no_rest);
  for (std::size_t i = 0; i < particles.size(); ++i)
  {
    // Both rows are sorted by the second partner: walk them together.
    std::size_t old_pair = i + 1 < list.row.size() ? list.row[i] : 0;
    const std::size_t old_end = i + 1 < list.row.size() ? list.row[i + 1] : 0;
    const auto leave = [&](ContactState &s)
    {
      release(s);
      losses.take(s);
    };
    for (std::size_t pair = new_list.row[i]; pair < static_cast<std::size_t>(new_list.row[i + 1]); ++pair)
    {
      while (old_pair < old_end && list.second[old_pair] < new_list.second[pair])
        leave(state[old_pair++]);
      if (old_pair < old_end && list.second[old_pair] == new_list.second[pair])
      {
        new_state[pair] = state[old_pair];
        new_rest[pair] = rest_until[old_pair];
        ++old_pair;
      }
    }
    while (old_pair < old_end)
      leave(state[old_pair++]);
  }
  list = std::move(new_list);
  state = std::move(new_state);
  rest_until = std::move(new_rest);
  resultant.assign(list.size(), {});
}

void PairContacts::reorder(const std::vector<std::int32_t> &order, const Particles &reordered)
{
  const std::vector<std::int32_t> new_index = inverse_order(order);
  std::vector<std::tuple<std::int32_t, std::int32_t, std::size_t>> pairs(list.size());
  for (std::size_t pair = 0; pair < list.size(); ++pair)
  {
    std::int32_t i = new_index[list.first[pair]], j = new_index[list.second[pair]];
    if (i > j)
    {
      std::swap(i, j);
      exchange_bodies(state[pair]);
    }
    pairs[pair] = {i, j, pair};
  }
  std::sort(pairs.begin(), pairs.end());

  VerletList sorted;
  sorted.row.assign(reordered.size() + 1, 0);
  std::vector<ContactState> sorted_state;
  std::vector<double> sorted_rest;
  for (const auto &[i, j, pair] : pairs)
  {
    ++sorted.row[i + 1];
    sorted.first.push_back(i);
    sorted.second.push_back(j);
    sorted_state.push_back(state[pair]);
    sorted_rest.push_back(rest_until[pair]);
  }
  for (std::size_t i = 0; i < reordered.size(); ++i)
    sorted.row[i + 1] += sorted.row[i];
  list = std::move(sorted);
  state = std::move(sorted_state);
  rest_until = std::move(sorted_rest);
}

void PairContacts::compute(const Particles &p, const ContactLaw &law, const ContactParameters &parameters,
                           const double time_step)
{
  std::int64_t undecided = 0, searches = 0;
#pragma omp parallel for schedule(static) reduction(+ : undecided, searches)
  for (std::size_t pair = 0; pair < list.size(); ++pair)
  {
    const std::int32_t i = list.first[pair], j = list.second[pair];
    if (p.motion[i] + p.motion[j] < rest_until[pair])
      continue;

    const Vec3 half_line = 0.5 * (p.position[j] - p.position[i]);
    const double radius = std::min(p.bounding_radius[i], p.bounding_radius[j]);
    const ContactMotion motion{time_step * radius * (p.angular_velocity[i].norm() + p.angular_velocity[j].norm()),
                               0.5 * time_step * (p.angular_velocity[i] + p.angular_velocity[j])};
    const auto displacement_at = [&](const ContactState &s) -> Vec3
    {
      return time_step * (p.velocity[j] + p.angular_velocity[j].cross(s.point - half_line) - p.velocity[i] -
                          p.angular_velocity[i].cross(s.point + half_line));
    };
    const auto search_pair = [&](ContactState &s)
    {
      ++searches;
      undecided += !search(p, i, j, s, rest_until[pair], law, parameters);
    };

    ContactState &s = state[pair];
    const Vec3 force = step_contact(s, law, motion, time_step, displacement_at, search_pair);
    resultant[pair] = {force, (half_line + s.point).cross(force), (half_line - s.point).cross(force)};
  }
  n_undecided += undecided;
  n_searches += searches;
}

} // namespace bergamo::dem
