#pragma once

#include "dem/flow/inlet_parameters.h"
#include "dem/flow/throughput.h"
#include "dem/simulation/simulation.h"

#include <cstdint>

namespace bergamo::dem
{

class OccupiedBox;

/// Brings grains into a simulation at a rate. The rate times the time since its beginning, less what has come in, is
/// its debt; while that covers the next grain of the grading, the grain is placed at random where it overlaps no body,
/// no wall and no other new grain (occupied_box.h). Grains come one after another and none overtakes, so their sizes
/// are those of the grading: if the next one finds no place, the box counts as full, nothing comes in and the debt is
/// kept. So after an addition the debt is in [0, next grain) unless grains are waiting, and those come as soon as there
/// is room.
///
/// It acts between the steps, after drift() and before an outlet that acts there too (outlet.h). What comes follows
/// from the seed and the state of the simulation alone: the same bits on any number of threads and after any restart.
class Inlet
{
public:
  /// Begins at the present time. Throws ConfigError for a value out of its range, a box that is behind a wall, or a
  /// periodic cell.
  Inlet(const InletParameters &parameters, const Simulation &simulation);

  /// Every so many steps: adds the grains that are due and find a place.
  /// @return what came in now. Throws ConfigError between the forces of a step and its drift.
  Exchange act(Simulation &simulation);

  const Throughput &passed() const { return sum; } ///< since the beginning

  /// What should have come in by now and has not: [kg], or grains if the rate is one of numbers.
  double debt(const Simulation &simulation) const { return debt_after(sum, simulation.time); }

  /// Whole grains that are due and wait for room. Draws them: the cost grows with their number.
  std::int64_t n_waiting(const Simulation &simulation) const;

  /// That the next grain takes off the debt: its mass [kg], or 1.
  double next_share() const { return share_of(next); }

  template <class Self, class Visit>
  static void visit_state(Self &self, Visit &visit)
  {
    visit("start_time", self.start_time);
    visit("passed", self.sum);
    visit("n_tried", self.n_tried);
    if constexpr (Visit::is_reading)
      self.next = self.grain(self.sum.n_grains);
  }

private:
  Superquadric grain(std::int64_t number) const;
  double share_of(const Superquadric &grain) const;
  double debt_after(const Throughput &some, double time) const;
  bool place_next(OccupiedBox &occupied, Particles &come);

  InletParameters p;
  double density; // [kg/m^3]
  double largest; // bounding radius of any grain [m]
  double start_time;
  Throughput sum;
  std::int64_t n_tried = 0; // places
  Superquadric next;        // grain of number sum.n_grains
};

} // namespace bergamo::dem
