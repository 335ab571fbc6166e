#include "dem/core/error.h"
#include "dem/simulation/simulation.h"

#include "tests/threads.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <functional>
#include <limits>
#include <sstream>
#include <string>
#include <type_traits>
#include <vector>

using namespace bergamo;
using namespace bergamo::dem;

namespace
{

constexpr double no_number = std::numeric_limits<double>::quiet_NaN(),
                 infinity = std::numeric_limits<double>::infinity();
constexpr double radius = 1e-3;

/// A row of grains on a floor that touch one another: spheres 0 and 1, superquadrics 2 and 3. Grain 4 lies apart. The
/// places go against the numbers, so that the arrays are sorted otherwise.
Simulation row_of_grains()
{
  SimulationParameters p;
  p.grain() = {1e8, 0.2, 2650.};
  p.wall() = p.grain();
  p.between_grains().friction = 0.3;
  p.with_walls().friction = 0.3;
  p.time_step = 1e-6;
  p.gravity = Vec3(0.1, 0., -9.81);
  const Superquadric sphere{Vec3::Constant(radius), 1., 1.}, rounded{Vec3::Constant(radius), 0.9, 0.95};
  Particles grains;
  for (int i = 0; i < 4; ++i)
    grains.add(i < 2 ? sphere : rounded, p.grain().density, Vec3(-1.999 * radius * i, 0., 0.), Quaternion::Identity());
  grains.add(sphere, p.grain().density, Vec3(20. * radius, 20. * radius, 20. * radius), Quaternion::Identity());
  grains.velocity[1] = Vec3(0., 1e-3, 0.); // tangential forces
  PlaneWall floor;
  floor.point = Vec3(0., 0., -0.9995 * radius);
  Simulation simulation(p, grains, {floor});
  for (int i = 0; i < 20; ++i)
    simulation.step();
  return simulation;
}

/// What one step says.
std::string message_of_step(Simulation &simulation)
{
  try
  {
    simulation.step();
  }
  catch (const RunError &error)
  {
    return error.what();
  }
  return "";
}

template <class T>
std::string text_of(const T &value)
{
  std::ostringstream text;
  text << value;
  return text.str();
}

/// The grain 4 jumps so far that this step renews the neighbours.
void leave_the_neighbours(Simulation &s)
{
  const auto i = s.index_of(4);
  s.particles.position[i] += Vec3(radius, 0., 0.);
  s.particles.parts.motion[i] += radius;
  s.particles.largest_motion += radius;
}

/// Reaches the stored states of one contact through the visit of all state: change(state) of the one in a store of
/// this kind whose bodies are these.
template <class Store, class Change>
struct ChangeState
{
  static constexpr bool is_reading = false;
  std::int32_t body1, body2; ///< the second may be a wall
  Change change;
  int n_changed = 0;

  template <class T>
  void operator()(const char *, T &value)
  {
    if constexpr (std::is_same_v<T, Store>)
    {
      for (std::size_t slot = 0; slot < value.n_slots(); ++slot)
        if (value.pair[slot] != Store::free_slot && value.first[slot] == body1 && value.second[slot] == body2)
        {
          auto state = value.get(static_cast<std::int32_t>(slot));
          change(state);
          value.set(static_cast<std::int32_t>(slot), state);
          ++n_changed;
        }
    }
    else if constexpr (requires { T::visit_state(value, *this); })
      T::visit_state(value, *this);
    else if constexpr (requires { T::value_type::visit_state(value[0], *this); })
      for (auto &one : value)
        (*this)("", one);
  }
};

template <class Set, class Change>
void change_state(std::vector<Set> &sets, const std::int32_t body1, const std::int32_t body2, const Change &change)
{
  using Store = std::remove_cvref_t<decltype(sets[0].touching())>;
  ChangeState<Store, Change> visit{body1, body2, change};
  for (Set &set : sets)
    Set::visit_state(set, visit);
  REQUIRE(visit.n_changed == 1);
}

} // namespace

TEST_CASE("the row of grains has contacts of every kind, and its jump renews the neighbours")
{
  const Threads one_thread(1);
  Simulation simulation = row_of_grains();
  CHECK(simulation.contacts.sphere_sphere[0].n_touching() == 1); // else the cases below prove nothing
  CHECK(simulation.contacts.grain_grain[0].n_touching() == 2);
  CHECK(simulation.contacts.n_touching_walls() == 4);
  const auto n_rebuilds = simulation.n_rebuilds();
  CHECK(message_of_step(simulation) == "");
  CHECK(simulation.n_rebuilds() == n_rebuilds);
  leave_the_neighbours(simulation);
  CHECK(message_of_step(simulation) == "");
  CHECK(simulation.n_rebuilds() == n_rebuilds + 1);
}

TEST_CASE("a state of a grain that is no number is found in the same step, with grain, place and time")
{
  const Threads one_thread(1);
  Simulation start = row_of_grains();
  start.sort_by_place();
  const std::vector<Vec3> when_built = start.particles.position;
  using Number = std::function<double &(Particles &, std::size_t)>;
  const std::vector<std::pair<std::string, Number>> numbers{
      {"position x", [](Particles &p, const std::size_t i) -> double & { return p.position[i][0]; }},
      {"position z", [](Particles &p, const std::size_t i) -> double & { return p.position[i][2]; }},
      {"velocity", [](Particles &p, const std::size_t i) -> double & { return p.velocity[i][1]; }},
      {"angular momentum", [](Particles &p, const std::size_t i) -> double & { return p.angular_momentum[i][2]; }},
      {"angular velocity", [](Particles &p, const std::size_t i) -> double & { return p.angular_velocity[i][0]; }},
      {"orientation x", [](Particles &p, const std::size_t i) -> double & { return p.orientation[i].x(); }},
      {"orientation w", [](Particles &p, const std::size_t i) -> double & { return p.orientation[i].w(); }}};
  for (const auto &[name, number] : numbers)
    for (const int id : {0, 1, 2, 3})
      for (const double value : {no_number, infinity, -infinity})
        for (const bool is_renewal : {false, true})
          for (const bool is_refreshed : {false, true}) // with every contact searched anew
          {
            Simulation simulation = start;
            const auto i = simulation.index_of(id);
            const Vec3 place = simulation.particles.position[i];
            number(simulation.particles, i) = value;
            if (is_renewal)
              leave_the_neighbours(simulation);
            if (is_refreshed)
              simulation.refresh_contacts();
            const std::string message = message_of_step(simulation);
            CAPTURE(name, id, value, is_renewal, is_refreshed, message);
            CHECK_THAT(message, Catch::Contains("grain " + text_of(id)) && Catch::Contains("state is not finite") &&
                                    Catch::Contains("time " + text_of(start.time) + " s") &&
                                    Catch::Contains("smaller time step"));
            if (name.starts_with("position")) // its own place is not known: where its neighbours were last listed
              CHECK_THAT(message, Catch::Contains("last seen at (" + text_of(when_built[i].transpose()) + ") m"));
            else
              CHECK_THAT(message, Catch::Contains("at (" + text_of(place.transpose()) + ") m"));
            CHECK(simulation.n_steps == start.n_steps);
          }
}

TEST_CASE("a state of a contact that is no number is found in the same step, at one of its grains")
{
  const Threads one_thread(1);
  const Simulation start = row_of_grains();
  enum class Kind
  {
    spheres,
    grains,
    wall
  };
  for (const Kind kind : {Kind::spheres, Kind::grains, Kind::wall})
    for (const std::string name : {"tangential", "normal", "overlap", "stiffness", "weight"})
      for (const bool is_renewal : {false, true})
        for (const bool is_refreshed : {false, true})
        {
          if (is_refreshed && name == "weight")
            continue; // and so does the refreshing
          Simulation simulation = start;
          std::vector<int> ids;
          const auto spoil = [&](auto &state)
          {
            if (name == "tangential")
              state.forces.tangential[1] = no_number;
            else if (name == "normal")
              state.forces.normal = no_number; // counts in the energy lost only
            else if (name == "overlap")
            {
              if constexpr (requires { state.root_overlap; })
                state.root_overlap = no_number;
              else
                state.overlap = no_number;
            }
            else if (name == "weight")
              state.weight = no_number;
            else if constexpr (requires { state.normal_stiffness; })
              state.normal_stiffness = no_number;
            else
              state.stiffness.normal = no_number;
          };
          const auto between = [&](const int id1, const int id2)
          {
            ids = {id1, id2};
            return std::minmax({simulation.index_of(id1), simulation.index_of(id2)});
          };
          if (kind == Kind::spheres)
          {
            const auto [i, j] = between(0, 1);
            change_state(simulation.contacts.sphere_sphere, i, j, spoil);
          }
          else if (kind == Kind::grains)
          {
            const auto [i, j] = between(2, 3);
            change_state(simulation.contacts.grain_grain, i, j, spoil);
          }
          else
          {
            ids = {1};
            change_state(simulation.contacts.grain_plane, simulation.index_of(1), 0, spoil);
          }
          if (is_refreshed)
            simulation.refresh_contacts();
          if (is_renewal)
            leave_the_neighbours(simulation);
          const std::string message = message_of_step(simulation);
          bool is_named = false;
          for (const int id : ids)
          {
            const Vec3 place = start.particles.position[start.index_of(id)];
            is_named = is_named || message.find("grain " + text_of(id) + " at (" + text_of(place.transpose()) +
                                                ") m on which the force is not finite") != std::string::npos;
          }
          CAPTURE(static_cast<int>(kind), name, is_renewal, is_refreshed, message);
          CHECK(is_named);
          CHECK_THAT(message, Catch::Contains("time " + text_of(start.time) + " s"));
        }
}

TEST_CASE("grains and forces from outside that are no numbers are refused")
{
  const Threads one_thread(1);
  Simulation simulation = row_of_grains();
  simulation.particles.external_force.assign(5, Vec3::Zero());
  simulation.particles.external_force[simulation.index_of(4)][1] = no_number;
  CHECK_THAT(message_of_step(simulation), Catch::Contains("grain 4 at (") && Catch::Contains("force is not finite"));

  simulation.particles.external_force[simulation.index_of(4)][1] = 1e200; // finite, but not what it moves to
  CHECK_THAT(message_of_step(simulation), Catch::Contains("grain 4 at (") && Catch::Contains("force is too large"));

  Particles grains = row_of_grains().particles;
  grains.position[2][0] = no_number;
  CHECK_THROWS_WITH(Simulation(SimulationParameters(), grains, {}),
                    Catch::Contains("grain " + text_of(grains.id[2])) && Catch::Contains("must be finite"));
}
