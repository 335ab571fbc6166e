#pragma once

#include "dem/force/pair_contacts.h"
#include "dem/force/wall_contacts.h"
#include "dem/measure/energy.h"
#include "dem/periodic/cell_work.h"
#include "dem/state/material.h"
#include "dem/state/particles.h"
#include "dem/state/wall.h"

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace bergamo::dem
{

/// Physics and numerics of a simulation.
struct SimulationParameters
{
  Material grain;
  Material wall;
  double friction = 0.24;
  double wall_friction = 0.;
  double damping_ratio = 0.9;   ///< dashpot, share of critical damping
  double relaxation_time = 0.;  ///< A of the viscoelastic law, beside the dashpot [s]
  Vec3 gravity = Vec3::Zero();  ///< [m/s^2]
  double time_step = 2.5e-7;    ///< [s]
  double verlet_distance = 0.1; ///< over the mean bounding radius
  int sort_interval = 100;      ///< renewals of the neighbours between two sorts of the grains by place
  ContactParameters contact;

  /// Throws ConfigError for a value out of its range.
  void validate() const;
};

/// Grains and walls, stepped by leapfrog in the order of Wellmann's fig. 3.12:
/// neighbours when needed, contacts, forces, motion. One step is compute_forces() and then integrate(); forces from
/// elsewhere are put into particles.external_force in between. The same bits on any number of threads.
class Simulation
{
public:
  /// @param particles at least one; a periodic cell of theirs must be at least two ranges of contacts wide, and has
  /// neither walls nor gravity; @param walls their velocities may be changed between steps
  Simulation(const SimulationParameters &parameters, Particles particles, std::vector<PlaneWall> walls);

  void compute_forces(); ///< contacts and their resultants at the present step; particles.cell.acceleration may follow
  void integrate();      ///< kick, turn and drift to the next step; throws RunError as check_finite() does

  void step()
  {
    compute_forces();
    integrate();
  }

  /// Goes on with other parameters: friction, time step, contact search. Materials and Verlet distance stay.
  void change(const SimulationParameters &parameters);

  void remove_wall(std::int32_t index);

  /// Searches every contact anew at the next step, e.g. after the grains' weights have been changed.
  void refresh_contacts();

  /// Stops all grains where they are.
  void rest();

  /// Starts the energy accounts (losses and works) anew from zero.
  void reset_accounts();

  /// Sorts the grains by place for locality; ids keep who is who.
  void sort_by_place();

  /// Energies at the present step; to be called between compute_forces() and integrate().
  GrainEnergy energy() const;

  /// Principal mean stresses of the periodic cell, tension positive (Wellmann 5.3) [Pa]. After compute_forces().
  Vec3 cell_stress() const { return pairs.virial().branch / particles.cell.volume(); }

  /// See dem/motion/stable_step.h [s].
  double stable_time_step() const;

  /// Throws RunError naming grain, place and time if any state is not finite.
  void check_finite() const;

  const SimulationParameters &parameters() const { return p; }

  Particles particles;
  std::vector<PlaneWall> walls;
  PairContacts pairs;
  WallContacts wall_contacts;
  std::vector<std::int32_t> index_of_id; ///< place of a grain in the arrays by its id
  double time = 0.;                      ///< [s]
  std::int64_t n_steps = 0;
  std::int64_t n_rebuilds = 0;
  PhaseTimes times;

  /// What a restart needs beyond the public state; dem/io/snapshot stores it.
  struct Hidden
  {
    double verlet_distance = 0.; ///< [m]
    double look_at_motion = 0.;  ///< particles.largest_motion below which no grain can have left its neighbours [m]
    std::int64_t n_rebuilds_when_sorted = 0;
    std::vector<Vec3> position_when_built;
    std::vector<double> wall_motion_when_built;
    double start_potential = 0.;           ///< of gravity when the accounts were opened [J]
    double removed_wall_work = 0.;         ///< done since then by walls that were removed [J]
    Vec3 edges_when_built = Vec3::Zero();  ///< of the periodic cell [m]
    CellWork cell_work;                    ///< since then
    std::vector<double> external_work;     ///< done on each grain since then, or empty [J]
    std::vector<Vec3> last_external_force; ///< [N], or empty
  };
  const Hidden &hidden() const { return h; }

  /// A simulation without grains, to be filled by dem/io/snapshot: every public member, then restore().
  static std::unique_ptr<Simulation> empty(const SimulationParameters &parameters);
  void restore(Hidden hidden) { h = std::move(hidden); }

private:
  bool grains_left_their_neighbours();
  double contact_range() const;
  void rebuild_neighbours();
  void book_external_work();
  void check_cell() const;
  void return_to_cell();
  void sum_contact_forces();
  [[noreturn]] void report_divergence() const;
  [[noreturn]] void throw_diverged(std::size_t i, const char *trouble) const;
  double gravity_potential() const;

  explicit Simulation(const SimulationParameters &parameters);

  SimulationParameters p;
  ContactLaw pair_law, wall_law;
  Hidden h;
};

} // namespace bergamo::dem
