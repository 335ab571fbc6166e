#pragma once

#include "dem/flow/throughput.h"
#include "dem/packing/space.h"
#include "dem/simulation/simulation.h"

#include <cstdint>
#include <variant>
#include <vector>

namespace bergamo::dem
{

/// When a grain is in an outlet.
enum class OutletRule
{
  centre,      ///< its centre is
  whole_grain, ///< its bounding sphere is, as a whole
};

/// Where grains are taken away.
struct OutletParameters
{
  std::variant<Box, HalfSpace> region = HalfSpace{Vec3::UnitZ(), 0.}; ///< a box may be infinite in any direction
  OutletRule rule = OutletRule::centre;
  int step_interval = 100; ///< steps between two checks; each costs one look at every grain

  /// Throws ConfigError for a value out of its range.
  void validate() const;
};

/// Takes grains out of a simulation once they are in a region. Fixed grains are walls and stay. It acts at any point of
/// a step from one drift to the next; after an inlet where both act between the steps, since it needs the forces of the
/// step, after which nothing can be added:
///
///   drift(); inlet.act(); outlet.act(); compute_forces(); kick(); [read]; drift(); ..
///
/// A grain that leaves while it touches others acts on them in the step in which it leaves, and no more: what their
/// contact held is booked as taken away, and half a step's work of its force is missed, of first order in the step.
class Outlet
{
public:
  /// Throws ConfigError for a value out of its range.
  explicit Outlet(const OutletParameters &parameters);

  /// Every so many steps: removes the grains that are in the region. The same on any number of threads.
  /// @return what left now. Throws RunError where no grain, fixed ones included, would be left, and ConfigError for a
  /// periodic cell, which has no outside.
  Exchange act(Simulation &simulation);

  const Throughput &passed() const { return sum; }                                ///< since the start
  const std::vector<std::int64_t> &ids_of_last_check() const { return last_ids; } ///< in the order of the arrays

  template <class Self, class Visit>
  static void visit_state(Self &self, Visit &visit)
  {
    visit("passed", self.sum);
    visit("ids_of_last_check", self.last_ids);
  }

private:
  std::vector<std::int32_t> grains_inside(const Particles &grains) const;

  OutletParameters p;
  Throughput sum;
  std::vector<std::int64_t> last_ids;
};

} // namespace bergamo::dem
