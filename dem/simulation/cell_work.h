#pragma once

#include "dem/state/particles.h"

namespace bergamo::dem
{

/// Work that the deformation of a periodic cell does on its grains, by the trapezoidal rule that closes leapfrog's
/// balance: of the contacts across the faces, of the affine changes of the velocities, and what the kinetic energy
/// changes by where a grain is put back into the cell and gets the velocity of its image.
struct CellWork
{
  double sum = 0.;                 ///< [J]
  double half_kick = 0.;           ///< of the last step's change of the rate, of which half belongs to the next one [J]
  Vec3 image_force = Vec3::Zero(); ///< of the contacts across the faces at the last step [N]

  /// Books the last step's work of the contacts. @param force across the faces at this step, see Virial::image [N]
  /// @param drift of the last step [s]
  void book_contacts(const PeriodicCell &cell, const Vec3 &force, double drift);

  /// What the accounts say at this step, when the cell's acceleration is set [J]. @param drift that led here [s]
  double at_this_step(const Particles &particles, double drift) const;

  /// Books the half of this step's change of the rate that belongs to the drift that led here; before the grains move.
  void begin_kick(const Particles &particles, double drift);

  /// Keeps the half that belongs to the drift just made; after the grains have moved, before the cell does.
  void end_kick(const Particles &particles, double drift);

  template <class Self, class Visit>
  static void visit_state(Self &self, Visit &visit)
  {
    visit("sum", self.sum);
    visit("half_kick", self.half_kick);
    visit("image_force", self.image_force);
  }
};

/// Puts grains that have left the cell back into it, with the velocities of their images; those of a weight below 1
/// stay, since they are tied to places of a continuum. Neighbours are found wherever grains are, up to a quarter of an
/// edge beyond the cell. What a contact with a plane remembers is counted from the grain's centre and goes along: the
/// plane is the same there.
/// @return change of the kinetic energy [J]
double return_to_cell(Particles &particles);

/// d2L/dt2 / L: the acceleration of a grain is that times its place [1/s^2]. Zero without a cell.
Vec3 stretching(const PeriodicCell &cell);

} // namespace bergamo::dem
