#include "dem/io/snapshot.h"

#include "dem/core/error.h"

#include <cstring>
#include <span>

namespace bergamo::dem
{
namespace
{

/// Views arrays of plain structs of doubles as doubles, and back.
template <class T>
std::span<const double> as_doubles(const std::vector<T> &values)
{
  static_assert(sizeof(T) % sizeof(double) == 0);
  return {reinterpret_cast<const double *>(values.data()), values.size() * (sizeof(T) / sizeof(double))};
}

template <class T>
void read_structs(const ArchiveReader &archive, const std::string &name, std::vector<T> &values)
{
  static_assert(sizeof(T) % sizeof(double) == 0);
  const std::vector<double> numbers = archive.read_doubles(name);
  constexpr std::size_t n = sizeof(T) / sizeof(double);
  if (numbers.size() % n != 0)
    throw RunError("the snapshot's array " + name + " has " + std::to_string(numbers.size()) +
                   " numbers, not a multiple of " + std::to_string(n) +
                   ": it was written by another version; start the run anew");
  values.resize(numbers.size() / n);
  if (!numbers.empty())
    std::memcpy(static_cast<void *>(values.data()), numbers.data(), numbers.size() * sizeof(double));
}

/// Directions that need no more than single precision.
std::vector<Vec3> as_vectors(const std::vector<Eigen::Vector3f> &directions)
{
  std::vector<Vec3> vectors;
  for (const Eigen::Vector3f &d : directions)
    vectors.push_back(d.cast<double>());
  return vectors;
}

template <class State>
void write_states(ArchiveWriter &archive, const std::string &name, const State &store)
{
  archive.write(name, as_doubles(store.states()));
}

template <template <class> class State>
void read_states(const ArchiveReader &archive, const std::string &name, ContactStore<State> &store)
{
  std::vector<State<double>> states;
  read_structs(archive, name, states);
  store.restore(states);
}

void write_indices(ArchiveWriter &archive, const std::string &name, const std::vector<std::int32_t> &values)
{
  archive.write(name, std::vector<std::int64_t>(values.begin(), values.end()));
}

std::vector<std::int32_t> read_indices(const ArchiveReader &archive, const std::string &name)
{
  const std::vector<std::int64_t> values = archive.read_integers(name);
  return {values.begin(), values.end()};
}

/// State of a periodic cell, in a fixed order.
template <class Cell, class Hidden, class Visit>
void visit_cell(Cell &cell, Hidden &h, Visit &&visit)
{
  visit("dem/cell/edges", cell.edges);
  visit("dem/cell/rate", cell.rate);
  visit("dem/cell/acceleration", cell.acceleration);
  visit("dem/cell/edges_when_built", h.edges_when_built);
  visit("dem/cell/image_force", h.cell_work.image_force);
  visit("dem/cell/work", h.cell_work.sum);
  visit("dem/cell/half_kick", h.cell_work.half_kick);
  visit("dem/cell/motion", cell.motion);
}

/// Every array of doubles of the simulation, once, for writing and for reading.
template <class Simulation, class Hidden, class Visit>
void visit_arrays(Simulation &s, Hidden &h, Visit &&visit)
{
  visit("dem/particles/shape", s.particles.shape);
  visit("dem/particles/mass", s.particles.mass);
  visit("dem/particles/inertia", s.particles.inertia);
  visit("dem/particles/bounding_radius", s.particles.bounding_radius);
  visit("dem/particles/position", s.particles.position);
  visit("dem/particles/orientation", s.particles.orientation);
  visit("dem/particles/velocity", s.particles.velocity);
  visit("dem/particles/angular_momentum", s.particles.angular_momentum);
  visit("dem/particles/angular_velocity", s.particles.angular_velocity);
  visit("dem/particles/force", s.particles.force);
  visit("dem/particles/torque", s.particles.torque);
  visit("dem/particles/external_force", s.particles.external_force);
  visit("dem/particles/weight", s.particles.weight);
  visit("dem/particles/motion", s.particles.motion);
  visit("dem/walls", s.walls);
  visit("dem/pairs/rest_mark", s.pairs.rest_until);
  visit("dem/wall_contacts/rest_mark", s.wall_contacts.rest_until);
  visit("dem/hidden/position_when_built", h.position_when_built);
  visit("dem/hidden/wall_motion_when_built", h.wall_motion_when_built);
  visit("dem/hidden/external_work", h.external_work);
  visit("dem/hidden/last_external_force", h.last_external_force);
}

template <class Simulation, class Visit>
void visit_indices(Simulation &s, Visit &&visit)
{
  visit("dem/pairs/row", s.pairs.list.row);
  visit("dem/pairs/first", s.pairs.list.first);
  visit("dem/pairs/second", s.pairs.list.second);
  visit("dem/pairs/slot", s.pairs.slot);
  visit("dem/pairs/grains/pair", s.pairs.grains.pair);
  visit("dem/pairs/grains/first", s.pairs.grains.first);
  visit("dem/pairs/grains/second", s.pairs.grains.second);
  visit("dem/pairs/spheres/pair", s.pairs.spheres.pair);
  visit("dem/pairs/spheres/first", s.pairs.spheres.first);
  visit("dem/pairs/spheres/second", s.pairs.spheres.second);
  visit("dem/wall_contacts/row", s.wall_contacts.row);
  visit("dem/wall_contacts/particle", s.wall_contacts.particle);
  visit("dem/wall_contacts/wall", s.wall_contacts.wall);
  visit("dem/wall_contacts/slot", s.wall_contacts.slot);
  visit("dem/wall_contacts/touching/pair", s.wall_contacts.touching.pair);
  visit("dem/wall_contacts/touching/first", s.wall_contacts.touching.first);
  visit("dem/wall_contacts/touching/second", s.wall_contacts.touching.second);
  visit("dem/index_of_id", s.index_of_id);
}

/// Scalars in a fixed order.
template <class Simulation, class Hidden, class Visit>
void visit_scalars(Simulation &s, Hidden &h, Visit &&visit)
{
  visit("dem/time", s.time);
  visit("dem/particles/largest_motion", s.particles.largest_motion);
  visit("dem/pairs/friction_loss", s.pairs.losses.friction);
  visit("dem/pairs/viscous_loss", s.pairs.losses.viscous);
  visit("dem/pairs/curvature_work", s.pairs.losses.curvature);
  visit("dem/wall_contacts/curvature_work", s.wall_contacts.losses.curvature);
  visit("dem/wall_contacts/friction_loss", s.wall_contacts.losses.friction);
  visit("dem/wall_contacts/viscous_loss", s.wall_contacts.losses.viscous);
  visit("dem/hidden/verlet_distance", h.verlet_distance);
  visit("dem/hidden/look_at_motion", h.look_at_motion);
  visit("dem/hidden/start_potential", h.start_potential);
  visit("dem/hidden/removed_wall_work", h.removed_wall_work);
  visit("dem/hidden/n_rebuilds_when_sorted", h.n_rebuilds_when_sorted);
  visit("dem/n_steps", s.n_steps);
  visit("dem/n_rebuilds", s.n_rebuilds);
  visit("dem/pairs/n_undecided", s.pairs.n_undecided);
  visit("dem/pairs/n_searches", s.pairs.n_searches);
  visit("dem/wall_contacts/n_searches", s.wall_contacts.n_searches);
}

void read_cell(const ArchiveReader &archive, Simulation &s, Simulation::Hidden &hidden)
{
  visit_cell(s.particles.cell, hidden,
             [&]<class T>(const char *name, T &value)
             {
               if constexpr (std::is_same_v<T, Vec3>)
                 archive.read_into(name, std::span<double>(value.data(), 3));
               else
                 value = archive.read_double(name);
             });
  s.particles.cell.update_images();
  const std::vector<std::int32_t> images = read_indices(archive, "dem/pairs/image");
  s.pairs.list.image.assign(images.begin(), images.end());
}

/// Gives the slots of a store the images of their pairs.
template <template <class> class State>
void take_images(const VerletList &list, ContactStore<State> &store)
{
  store.image.assign(store.n_slots(), own_image);
  for (std::size_t slot = 0; slot < store.n_slots(); ++slot)
    if (store.pair[slot] != store.free_slot)
      store.image[slot] = list.image[store.pair[slot]];
}

} // namespace

void write_simulation(ArchiveWriter &archive, const Simulation &s)
{
  archive.write("dem/particles/id", s.particles.id);
  archive.write("dem/friction", s.parameters().friction);
  archive.write("dem/time_step", s.parameters().time_step);
  visit_arrays(s, s.hidden(), [&](const char *name, const auto &values) { archive.write(name, as_doubles(values)); });
  visit_indices(s, [&](const char *name, const auto &values) { write_indices(archive, name, values); });
  visit_scalars(s, s.hidden(), [&](const char *name, const auto value) { archive.write(name, value); });
  if (s.particles.cell.is_periodic())
  {
    visit_cell(s.particles.cell, s.hidden(),
               [&]<class T>(const char *name, const T &value)
               {
                 if constexpr (std::is_same_v<T, Vec3>)
                   archive.write(name, std::span<const double>(value.data(), 3));
                 else
                   archive.write(name, value);
               });
    write_indices(archive, "dem/pairs/image", {s.pairs.list.image.begin(), s.pairs.list.image.end()});
  }
  archive.write("dem/pairs/separating_direction", as_doubles(as_vectors(s.pairs.separating_direction)));
  write_states(archive, "dem/pairs/grains/state", s.pairs.grains);
  write_states(archive, "dem/pairs/spheres/state", s.pairs.spheres);
  write_states(archive, "dem/wall_contacts/touching/state", s.wall_contacts.touching);
}

std::unique_ptr<Simulation> read_simulation(const ArchiveReader &archive, const SimulationParameters &parameters)
{
  SimulationParameters stored = parameters;
  stored.friction = archive.read_double("dem/friction");
  stored.time_step = archive.read_double("dem/time_step");
  Simulation::Hidden hidden;
  auto simulation = Simulation::empty(stored);
  Simulation &s = *simulation;
  s.particles.id = archive.read_integers("dem/particles/id");
  visit_arrays(s, hidden, [&](const char *name, auto &values) { read_structs(archive, name, values); });
  visit_indices(s, [&](const char *name, auto &values) { values = read_indices(archive, name); });
  visit_scalars(s, hidden,
                [&]<class T>(const char *name, T &value)
                {
                  if constexpr (std::is_same_v<T, double>)
                    value = archive.read_double(name);
                  else
                    value = archive.read_integer(name);
                });
  s.pairs.list.image.assign(s.pairs.list.size(), own_image);
  if (archive.has("dem/cell/edges"))
    read_cell(archive, s, hidden);
  for (const Superquadric &shape : s.particles.shape)
    s.pairs.is_sphere.push_back(shape.is_sphere());
  std::vector<Vec3> directions;
  read_structs(archive, "dem/pairs/separating_direction", directions);
  for (const Vec3 &d : directions)
    s.pairs.separating_direction.push_back(d.cast<float>());
  take_images(s.pairs.list, s.pairs.grains);
  take_images(s.pairs.list, s.pairs.spheres);
  read_states(archive, "dem/pairs/grains/state", s.pairs.grains);
  read_states(archive, "dem/pairs/spheres/state", s.pairs.spheres);
  read_states(archive, "dem/wall_contacts/touching/state", s.wall_contacts.touching);
  s.restore(std::move(hidden));
  return simulation;
}

} // namespace bergamo::dem
