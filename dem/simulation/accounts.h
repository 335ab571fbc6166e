#pragma once

#include "dem/simulation/cell_work.h"
#include "dem/state/particles.h"
#include "dem/state/wall.h"

#include <vector>

namespace bergamo::dem
{

/// Steps around the present instant: the drift that led here and the kick to come [s].
struct StepLengths
{
  double drift;     ///< of the step before
  double next_kick; ///< from the half step before to the half step after: the mean of both steps

  /// Of the half step before in the kick.
  double share_before() const { return 0.5 * drift / next_kick; }
};

/// Work done on the particles since the accounts were opened, by the trapezoidal rule that closes leapfrog's balance.
/// Losses in contacts are the matter of the contacts, the works of the walls that of the walls.
struct Accounts
{
  double start_potential = 0.;   ///< of gravity when the accounts were opened [J]
  double removed_wall_work = 0.; ///< done by walls that were removed since [J]
  double exchanged = 0.;         ///< energy that came with added particles, less what removed ones and walls took [J]
  double step_change = 0.;       ///< work of changes of the time step since [J]
  CellWork cell_work;
  std::vector<double> external_work;     ///< done on each particle, or empty [J]
  std::vector<Vec3> last_external_force; ///< [N], or empty

  /// Starts anew from zero. @param potential of gravity now [J]
  void reset(double potential);

  /// Books the work of the external forces over the drift that led here; before the kick. @param drift [s]
  void book_external_work(const Particles &particles, double drift);

  /// Work of the external forces on a particle up to this step, as book_external_work() will have it [J].
  double external_work_on(const Particles &particles, std::size_t i, double drift) const;

  /// Gives particles that were added their place in the accounts.
  void make_room(std::size_t n_particles);

  /// Takes the order of the particles, order[new] = old, of those that stay.
  void reorder(const std::vector<std::int32_t> &order);

  template <class Self, class Visit>
  static void visit_state(Self &self, Visit &visit)
  {
    visit("start_potential", self.start_potential);
    visit("removed_wall_work", self.removed_wall_work);
    visit("exchanged", self.exchanged);
    visit("step_change", self.step_change);
    visit("cell_work", self.cell_work);
    visit("external_work", self.external_work);
    visit("last_external_force", self.last_external_force);
  }
};

/// Potential of gravity of the free particles [J]. @param gravity [m/s^2]
double gravity_potential(const Particles &particles, const Vec3 &gravity);

/// Kinetic energy of one free particle at this step, from the half steps around: m v-.v+ / 2 and H-.T I^-1 T^T H+ / 2,
/// for steps h-, h+ that differ plus (1/2 - s) (m v-^2 - m v+^2) / 2 with s = h- / (h- + h+), and likewise for H: half
/// way between what closes the balance of the trapezoidal works before and after, see step_change_work() [J].
/// @param field_acceleration of gravity and cell at its place [m/s^2]
double kinetic_energy(const Particles &particles, std::size_t i, const Vec3 &field_acceleration,
                      const StepLengths &steps);

/// What a change of the time step puts into one free particle [J]: -(1/2 - s) m (v+ - v-)^2 with s as above, and
/// likewise for H; nothing where both steps are equal. Of the second order of the step: trapezoidal works over unequal
/// steps around a kick do not meet in one kinetic energy.
double step_change_work(const Particles &particles, std::size_t i, const Vec3 &field_acceleration,
                        const StepLengths &steps);

} // namespace bergamo::dem
