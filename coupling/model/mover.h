#pragma once

#include <string>

namespace bergamo::coupling
{

/// Energies of a mover [J], read between its kick and its drift. Couplings and other loads on the mover from outside
/// have no part in it.
struct MoverEnergy
{
  double kinetic = 0.;
  double stored = 0.; ///< in deformations and contacts
  double lost = 0.;   ///< by friction, damping and plastic flow since the start
  double work = 0.;   ///< of walls, of prescribed motions and of gravity since the start

  double balance() const { return kinetic + stored + lost - work; } ///< constant but for what others do to it
};

/// A part of a model that moves by the leapfrog: grains, a body. Every mover keeps one protocol, one step being
///   forces · kick · [read] · drift.
/// Forces belong to the present places, and asking for them again changes nothing. The kick takes the velocities from
/// the half step before to the half step after, over the mean of both steps; with it all that can be read of the
/// present step is fixed. The drift moves on to the next step. Reading never changes a run.
class Mover
{
public:
  explicit Mover(std::string name) : name_(std::move(name)) {}
  virtual ~Mover() = default;
  Mover(const Mover &) = delete;
  Mover &operator=(const Mover &) = delete;

  const std::string &name() const { return name_; } ///< for messages and tables

  /// Its own forces at the present places; the forces of others on it begin anew from zero.
  virtual void compute_forces() = 0;
  virtual void kick(double time_step) = 0;  ///< towards the step to come [s]
  virtual void drift(double time_step) = 0; ///< that of the kick [s]

  /// Largest stable step of the mover alone at its present state, from one computation of its own forces to the next
  /// [s].
  virtual double stable_step() = 0;
  /// Steps from one computation of its own forces to the next: more than 1 where it is subcycled.
  virtual int steps_per_force() const { return 1; }
  virtual MoverEnergy energy() const = 0;

private:
  std::string name_;
};

} // namespace bergamo::coupling
