#include "dem/state/particles.h"

#include "dem/core/error.h"
#include "dem/geometry/orientation.h"
#include "dem/geometry/rigid_clump.h"

#include <algorithm>
#include <limits>
#include <sstream>
#include <type_traits>
#include <utility>

namespace bergamo::dem
{
namespace
{

template <class T>
void permute(std::vector<T> &values, const std::vector<std::int32_t> &order)
{
  std::vector<T> sorted;
  sorted.reserve(values.size());
  for (const std::int32_t old : order)
    sorted.push_back(values[old]);
  values = std::move(sorted);
}

/// Appends entries begin .. end of all arrays of `others` that have such.
template <class Fields>
void append_entries(Fields &fields, const Fields &others, const std::size_t begin, const std::size_t end)
{
  std::vector<const void *> sources;
  Fields::visit_fields(others, [&](const char *, const auto &values) { sources.push_back(&values); });
  std::size_t field = 0;
  Fields::visit_fields(fields,
                       [&](const char *, auto &values)
                       {
                         const auto &source =
                             *static_cast<std::remove_reference_t<decltype(values)> const *>(sources[field++]);
                         if (!source.empty())
                           values.insert(values.end(), source.begin() + begin, source.begin() + end);
                       });
}

[[noreturn]] void refuse(const std::int64_t id, const std::string &what)
{
  throw ConfigError("grain " + std::to_string(id) + ' ' + what);
}

void check_length(const char *name, const std::size_t length, const std::size_t n)
{
  if (length != n)
    throw ConfigError("the array '" + std::string(name) + "' has " + std::to_string(length) + " entries for " +
                      std::to_string(n) + " grains: give one each");
}

} // namespace

void Particles::add(const Superquadric &shape, const double density, const Vec3 &new_position,
                    const Quaternion &new_orientation, const std::int32_t material)
{
  add(Clump(shape), density, new_position, new_orientation, material);
}

void Particles::add(const Clump &clump, const double density, const Vec3 &new_position,
                    const Quaternion &new_orientation, const std::int32_t material)
{
  require(density > 0. && std::isfinite(density), "density of a grain", density, "positive [kg/m^3]");
  require_finite(new_position, "place of a grain");
  const Quaternion unit = unit_orientation(new_orientation);
  const auto particle = static_cast<std::int32_t>(size());
  id.push_back(particle);
  volume.push_back(clump.volume());
  mass.push_back(density * clump.volume());
  inertia.push_back(density * clump.inertia_per_density());
  bounding_radius.push_back(clump.bounding_radius());
  position.push_back(new_position);
  orientation.push_back(unit);
  for (auto *motion : {&velocity, &angular_momentum, &drift_velocity, &angular_velocity, &force, &torque})
    motion->push_back(Vec3::Zero());
  turned.push_back(0.);
  weight.push_back(1.);

  for (const ClumpPart &part : clump.parts())
  {
    const double radius = dem::bounding_radius(part.shape);
    parts.particle.push_back(particle);
    parts.shape.push_back(part.shape);
    parts.material.push_back(material);
    parts.place.push_back(part.position);
    parts.turn.push_back(part.orientation);
    parts.bounding_radius.push_back(radius);
    parts.reach.push_back(part.position.norm() + radius);
    parts.swing.push_back(largest_swing(part.shape));
    parts.motion.push_back(0.);
  }
  first_part.push_back(static_cast<std::int32_t>(parts.size()));
}

void Particles::append(const Particles &others, const std::size_t i, const std::int64_t new_id)
{
  const std::size_t n = size(), n_parts = parts.size();
  for (std::vector<Vec3> *forces : {&external_force, &external_torque, &transfer_force, &transfer_torque})
    if (!forces->empty())
      forces->push_back(Vec3::Zero());
  append_entries(*this, others, i, i + 1);
  id[n] = new_id;
  append_entries(parts, others.parts, others.first_part[i], others.first_part[i + 1]);
  std::fill(parts.particle.begin() + n_parts, parts.particle.end(), static_cast<std::int32_t>(n));
  first_part.push_back(static_cast<std::int32_t>(parts.size()));
}

void Particles::look_at_weights()
{
  const bool are_all_one = std::all_of(weight.begin(), weight.end(), [](const double w) { return w == 1.; });
  for (std::vector<Vec3> *transfers : {&transfer_force, &transfer_torque})
    if (transfers->empty() != are_all_one)
      transfers->assign(are_all_one ? 0 : size(), Vec3::Zero());
}

void Particles::fix(const std::size_t i)
{
  mass[i] = std::numeric_limits<double>::infinity();
  inertia[i].setConstant(mass[i]);
  velocity[i].setZero();
  angular_momentum[i].setZero();
  angular_velocity[i].setZero();
}

void Particles::check(const std::int32_t n_materials) const
{
  const std::size_t n = size();
  visit_fields(*this,
               [&](const std::string &name, const auto &values)
               {
                 if (!is_optional(name) || !values.empty())
                   check_length(name.c_str(), values.size(), n);
               });
  Parts::visit_fields(parts,
                      [&](const char *name, const auto &values) { check_length(name, values.size(), parts.size()); });
  check_length("first_part", first_part.size() - 1, n);
  if (first_part.front() != 0 || static_cast<std::size_t>(first_part.back()) != parts.size())
    throw ConfigError("the parts of the grains end at " + std::to_string(first_part.back()) + " of " +
                      std::to_string(parts.size()) + ": first_part must lead from 0 to all of them");
  for (std::size_t i = 0; i < n; ++i)
  {
    const auto demand = [&](const bool holds, const char *what, const double value, const char *allowed)
    {
      std::ostringstream message;
      message << "has " << what << ' ' << value << ": it must be " << allowed;
      if (!holds)
        refuse(id[i], message.str());
    };
    const bool is_free = !is_fixed(i);
    demand(volume[i] > 0. && std::isfinite(volume[i]), "the volume", volume[i], "positive [m^3]");
    demand(mass[i] > 0., "the mass", mass[i], "positive [kg], or infinite for one that is fixed");
    demand(!is_free || ((inertia[i].array() > 0.).all() && inertia[i].allFinite()), "the least moment of inertia",
           inertia[i].minCoeff(), "positive and finite [kg m^2]");
    demand(bounding_radius[i] > 0. && std::isfinite(bounding_radius[i]), "the bounding radius", bounding_radius[i],
           "positive [m]");
    demand(weight[i] > 0. && weight[i] <= 1., "the weight", weight[i], "in (0, 1]");
    demand(position[i].allFinite(), "a place of", position[i].sum(), "finite [m]");
    demand(std::abs(orientation[i].norm() - 1.) < 1e-6, "a quaternion of norm", orientation[i].norm(), "1");
    demand(velocity[i].allFinite() && drift_velocity[i].allFinite(), "a velocity of", velocity[i].sum(),
           "finite [m/s]");
    demand(angular_momentum[i].allFinite() && angular_velocity[i].allFinite(), "an angular momentum of",
           angular_momentum[i].sum(), "finite [kg m^2/s]");
    if (!external_force.empty())
      demand(external_force[i].allFinite(), "an external force of", external_force[i].sum(), "finite [N]");
    if (!external_torque.empty())
      demand(external_torque[i].allFinite(), "an external torque of", external_torque[i].sum(), "finite [N m]");
    const std::int32_t n_parts = first_part[i + 1] - first_part[i];
    demand(n_parts >= 1, "a number of parts of", n_parts, "at least 1");
    for (auto k = first_part[i]; k < first_part[i + 1]; ++k)
    {
      parts.shape[k].validate();
      demand(parts.particle[k] == static_cast<std::int32_t>(i), "a part that names the particle", parts.particle[k],
             "the place of the grain in the arrays");
      demand(parts.place[k].allFinite() && (n_parts > 1 || parts.place[k] == Vec3::Zero()), "a part's place of",
             parts.place[k].sum(), "finite [m], and zero for the only part of a grain");
      demand(std::abs(parts.turn[k].norm() - 1.) < 1e-6 &&
                 (n_parts > 1 || parts.turn[k].coeffs() == Quaternion::Identity().coeffs()),
             "a part's quaternion of norm", parts.turn[k].norm(),
             "1, and no rotation for the only part of a grain: turn the grain instead");
      const double radius = parts.bounding_radius[k];
      demand(radius > 0. && std::isfinite(radius), "a part's bounding radius", radius, "positive [m]");
      demand(parts.reach[k] >= radius && parts.reach[k] <= bounding_radius[i], "a part's reach", parts.reach[k],
             "between its bounding radius and that of the grain [m]");
      demand(parts.material[k] >= 0 && parts.material[k] < n_materials, "the material", parts.material[k],
             "one of the simulation's table, counted from 0");
    }
  }
}

std::vector<std::int32_t> Particles::reorder(const std::vector<std::int32_t> &order)
{
  std::vector<std::int32_t> part_order, new_first{0};
  part_order.reserve(parts.size());
  for (const std::int32_t old : order)
  {
    for (auto k = first_part[old]; k < first_part[old + 1]; ++k)
      part_order.push_back(k);
    new_first.push_back(static_cast<std::int32_t>(part_order.size()));
  }
  visit_fields(*this,
               [&](const char *, auto &values)
               {
                 if (!values.empty())
                   permute(values, order);
               });
  Parts::visit_fields(parts, [&](const char *, auto &values) { permute(values, part_order); });
  first_part = std::move(new_first);
  for (std::size_t i = 0; i < size(); ++i)
    for (auto k = first_part[i]; k < first_part[i + 1]; ++k)
      parts.particle[k] = static_cast<std::int32_t>(i);
  return part_order;
}

} // namespace bergamo::dem
