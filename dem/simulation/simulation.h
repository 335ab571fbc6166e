#pragma once

#include "dem/core/phase_times.h"
#include "dem/force/contacts.h"
#include "dem/force/surface_loads.h"
#include "dem/neighbour/neighbour_watch.h"
#include "dem/simulation/accounts.h"
#include "dem/simulation/divergence.h"
#include "dem/simulation/energy.h"
#include "dem/simulation/simulation_parameters.h"
#include "dem/state/id_index.h"
#include "dem/state/particles.h"
#include "dem/state/surface.h"
#include "dem/state/wall.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace bergamo
{
class StateReader;
}

namespace bergamo::dem
{

struct CellCopies;

/// What left a simulation or came into it.
struct Exchange
{
  std::int64_t n_particles = 0;
  double mass = 0.;                   ///< [kg]
  Vec3 momentum = Vec3::Zero();       ///< at the half step before [kg m/s]
  std::vector<std::int64_t> ids = {}; ///< in the order of the arrays
};

/// Grains, walls and surfaces, stepped by leapfrog in the order of Wellmann's fig. 3.12. The protocol of a step is that
/// of every mover: compute_forces(), kick(), then what is to be read of the step, then drift(). Reading changes
/// nothing, forces may be asked for as often as one likes; forces from elsewhere are put into particles.external_force
/// before kick(). Velocities, of walls too, may be set between steps or before kick(): they count for the drift to
/// come. The same bits on any number of threads and after any restart.
class Simulation
{
public:
  /// @param particles at least one; a periodic cell of theirs must be at least two ranges of contacts wide, and has
  /// neither walls across the directions in which it repeats itself nor gravity along them. Between walls it must not
  /// deform. Throws ConfigError for whatever cannot run.
  Simulation(const SimulationParameters &parameters, Particles particles, std::vector<PlaneWall> walls);

  /// Goes on from a state that was stored. Throws RunError where the archive does not hold one.
  /// @param parameters of the run; what change() may have altered is taken from the archive
  Simulation(const SimulationParameters &parameters, StateReader &reader);

  void compute_forces(); ///< contacts and their resultants at the present step; once a step, then nothing changes
  void kick();           ///< fixes the forces of the step; particles.cell.acceleration has been set by now
  void drift();          ///< velocities to the next half step, places to the next step; throws RunError on divergence

  void integrate()
  {
    kick();
    drift();
  }
  void step()
  {
    compute_forces();
    integrate();
  }

  /// Goes on with other parameters, all but the elastic materials; between steps. Throws ConfigError for a material
  /// that differs.
  void change(const SimulationParameters &parameters);

  /// Between steps: removes a wall, or adds one; later walls move up by one. Throws ConfigError for a wall across a
  /// periodic cell.
  void remove_wall(std::int32_t index);
  void add_wall(const PlaneWall &wall);

  /// Copies of the periodic cell side by side, in a cell of as many edges: in the same balance, with the contacts of
  /// the cell and their history, so that they go on as the cell does until roundings part them. Between steps, or with
  /// the forces of a step. Energy accounts begin anew. Throws ConfigError for copies along what does not repeat itself.
  Simulation repeated(const CellCopies &copies) const;

  /// The cell repeats itself no more, in any direction: grains keep what they have but the contacts across its faces,
  /// whose energy is booked as exchanged. @param shift of all grains, along directions of the cell [m]
  void open_cell(const Vec3 &shift = Vec3::Zero());

  /// Between steps: adds a surface, at rest. Throws ConfigError as its validate() does, or in a periodic cell.
  void add_surface(Surface surface);
  /// As remove_wall(); later surfaces move up by one.
  void remove_surface(std::int32_t index);

  /// At this step, once its forces are known. Throws ConfigError for a surface that is not there. @{
  std::vector<Vec3> node_forces(std::int32_t surface) const; ///< by node [N]
  std::vector<SurfaceLoad> surface_loads() const;            ///< by surface
  /// @}

  /// Removes particles at the present step, of which the forces are computed first if they were not. Ids of the others
  /// stay, and so does the history of their contacts; the energy taken out is booked.
  /// @param indices places in the arrays, in any order
  Exchange remove(const std::vector<std::int32_t> &indices);

  /// Adds particles between steps; they get new ids, in their order. What they bring in is booked.
  /// Throws ConfigError as the constructor does. @param added without a cell of its own
  Exchange add(const Particles &added);

  /// Searches every contact anew at the next step, e.g. after the grains' weights have been changed.
  void refresh_contacts()
  {
    particles.look_at_weights();
    contacts.refresh(particles);
  }

  /// Between steps: gives grains other weights, with the velocities that they have, and has contacts searched anew
  /// where any differs. What that puts in as kinetic energy is booked as exchanged; contacts book theirs as curvature
  /// work.
  /// @param indices places in the arrays; @param weights in (0, 1]
  void change_weights(std::span<const std::int32_t> indices, std::span<const double> weights);

  /// Stops all grains where they are.
  void rest();

  /// Starts the energy accounts (losses and works) anew from zero.
  void reset_accounts();

  /// Sorts the grains by place for locality; ids keep who is who.
  void sort_by_place();

  /// Energies at the present step: between compute_forces() and drift().
  GrainEnergy energy() const;

  /// Principal mean stresses of the periodic cell, tension positive (Wellmann 5.3) [Pa]. After compute_forces(), before
  /// anything is removed. Throws ConfigError for a cell that does not repeat itself in all directions: it has no
  /// volume.
  Vec3 cell_stress() const
  {
    particles.cell.require_closed("the mean stress of a cell");
    return contacts.virial().branch / particles.cell.volume();
  }

  /// See dem/motion/stable_step.h [s].
  double stable_time_step() const;

  /// Throws RunError naming grain, place and time if any state is not finite.
  void check_finite() const;

  const SimulationParameters &parameters() const { return p; }

  /// What changes a rate by an acceleration has to reckon with the kick, not with the time step.
  StepLengths steps() const { return {last_step, 0.5 * (last_step + p.time_step)}; }

  std::int64_t n_rebuilds() const { return n_renewals; } ///< renewals of the neighbours since the start
  std::int32_t index_of(const std::int64_t id) const { return index(id); } ///< place of a grain in the arrays
  bool has(const std::int64_t id) const { return index.has(id); }
  /// Grows whenever grains may have changed their places in the arrays; not a part of the state.
  std::int64_t n_orders() const { return index.n_orders(); }

  /// Called before grains change their places in the arrays, or these grow: who reads them in place lets go of them.
  /// Not a part of the state.
  std::function<void()> before_moving{};

  Particles particles;
  std::vector<PlaneWall> walls;
  std::vector<Surface> surfaces; ///< see add_surface(); velocities of the nodes may be set
  Contacts contacts;
  double time = 0.; ///< [s]
  std::int64_t n_steps = 0;
  PhaseTimes times;

  /// All that a step depends on, by name: snapshot and hash follow from it. See dem/core/state.h.
  template <class Self, class Visit>
  static void visit_state(Self &self, Visit &visit)
  {
    visit("parameters", self.p);
    visit("particles", self.particles);
    visit("walls", self.walls);
    visit("surfaces", self.surfaces);
    visit("contacts", self.contacts);
    visit("watch", self.watch);
    visit("accounts", self.accounts);
    visit("time", self.time);
    visit("n_steps", self.n_steps);
    visit("last_step", self.last_step);
    visit("forces_are_known", self.forces_are_known);
    visit("n_renewals", self.n_renewals);
    visit("n_renewals_when_sorted", self.n_renewals_when_sorted);
    visit("next_id", self.next_id);
  }

private:
  Instant now() const { return {time, n_steps}; }
  void set_range();
  void check_cell() const;
  void renew_neighbours();
  void renew_strayed();
  void move_walls(double drift);
  void require_surface(std::int32_t index, const char *what) const;
  void load_surfaces();
  void move_surfaces(double drift);
  std::vector<std::vector<Vec3>> forces_of_moving() const;
  void announce_moving() const;
  void take_order(const std::vector<std::int32_t> &order);
  double kinetic_energy_of(std::size_t i) const;
  double step_change_here() const;

  SimulationParameters p;
  std::vector<ContactLaw> laws; // by pair of materials
  NeighbourWatch watch;
  Accounts accounts;
  IdIndex index;
  double last_step = 0.; // the drift that led here [s]
  bool forces_are_known = false;
  std::int64_t n_renewals = 0, n_renewals_when_sorted = 0, next_id = 0;
};

/// Hash of all that a step depends on.
std::uint64_t state_hash(const Simulation &simulation);

} // namespace bergamo::dem
