#include "dem/core/error.h"
#include "dem/simulation.h"

#include "tests/threads.h"

#include <catch2/catch.hpp>
#include <functional>
#include <limits>
#include <sstream>
#include <string>
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
  p.grain = {1e8, 0.2, 2650.};
  p.wall = p.grain;
  p.friction = 0.3;
  p.wall_friction = 0.3;
  p.time_step = 1e-6;
  p.gravity = Vec3(0.1, 0., -9.81);
  const Superquadric sphere{Vec3::Constant(radius), 1., 1.}, rounded{Vec3::Constant(radius), 0.9, 0.95};
  Particles grains;
  for (int i = 0; i < 4; ++i)
    grains.add(i < 2 ? sphere : rounded, p.grain.density, Vec3(-1.999 * radius * i, 0., 0.), Quaternion::Identity());
  grains.add(sphere, p.grain.density, Vec3(20. * radius, 20. * radius, 20. * radius), Quaternion::Identity());
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
  const auto i = s.index_of_id[4];
  s.particles.position[i] += Vec3(radius, 0., 0.);
  s.particles.motion[i] += radius;
  s.particles.largest_motion += radius;
}

std::int32_t pair_of(const Simulation &s, const int id1, const int id2)
{
  for (std::size_t pair = 0; pair < s.pairs.list.size(); ++pair)
  {
    const auto i = s.particles.id[s.pairs.list.first[pair]], j = s.particles.id[s.pairs.list.second[pair]];
    if ((i == id1 && j == id2) || (i == id2 && j == id1))
      return static_cast<std::int32_t>(pair);
  }
  return -1;
}

template <class Store, class Change>
void change_state(Store &store, const std::int32_t slot, Change &&change)
{
  REQUIRE(slot >= 0);
  auto state = store.get(slot);
  change(state);
  store.set(slot, state);
}

} // namespace

TEST_CASE("the row of grains has contacts of every kind, and its jump renews the neighbours")
{
  const Threads one_thread(1);
  Simulation simulation = row_of_grains();
  CHECK(simulation.pairs.spheres.size() == 1); // else the cases below prove nothing
  CHECK(simulation.pairs.grains.size() == 2);
  CHECK(simulation.wall_contacts.touching.size() == 4);
  const auto n_rebuilds = simulation.n_rebuilds;
  CHECK(message_of_step(simulation) == "");
  CHECK(simulation.n_rebuilds == n_rebuilds);
  leave_the_neighbours(simulation);
  CHECK(message_of_step(simulation) == "");
  CHECK(simulation.n_rebuilds == n_rebuilds + 1);
}

TEST_CASE("a state of a grain that is no number is found in the same step, with grain, place and time")
{
  const Threads one_thread(1);
  const Simulation start = row_of_grains();
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
            const auto i = simulation.index_of_id[id];
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
              CHECK_THAT(message, Catch::Contains("last seen at (" +
                                                  text_of(start.hidden().position_when_built[i].transpose()) + ") m"));
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
          if (is_refreshed && (name == "stiffness" || name == "weight") && kind != Kind::spheres)
            continue; // a search finds both anew
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
          PairContacts &pairs = simulation.pairs;
          if (kind == Kind::spheres)
          {
            ids = {0, 1};
            change_state(pairs.spheres, pairs.slot[pair_of(simulation, 0, 1)], spoil);
          }
          else if (kind == Kind::grains)
          {
            ids = {2, 3};
            change_state(pairs.grains, pairs.slot[pair_of(simulation, 2, 3)], spoil);
          }
          else
          {
            ids = {1};
            WallContacts &contacts = simulation.wall_contacts;
            change_state(contacts.touching, contacts.slot[contacts.row[simulation.index_of_id[1]]], spoil);
          }
          if (is_refreshed)
            simulation.refresh_contacts();
          if (is_renewal)
            leave_the_neighbours(simulation);
          const std::string message = message_of_step(simulation);
          bool is_named = false;
          for (const int id : ids)
          {
            const Vec3 place = start.particles.position[start.index_of_id[id]];
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
  simulation.particles.external_force[simulation.index_of_id[4]][1] = no_number;
  CHECK_THAT(message_of_step(simulation), Catch::Contains("grain 4 at (") && Catch::Contains("force is not finite"));

  simulation.particles.external_force[simulation.index_of_id[4]][1] = 1e200; // finite, but not what it moves to
  CHECK_THAT(message_of_step(simulation), Catch::Contains("grain 4 at (") && Catch::Contains("force is too large"));

  Particles grains = row_of_grains().particles;
  grains.position[2][0] = no_number;
  CHECK_THROWS_WITH(Simulation(SimulationParameters(), grains, {}),
                    Catch::Contains("grain " + text_of(grains.id[2])) && Catch::Contains("state is not finite"));
}
