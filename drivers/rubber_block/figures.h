#pragma once

#include "drivers/common/run/state_visitor.h"
#include "drivers/common/summary.h"
#include "drivers/rubber_block/pull.h"

namespace bergamo::driver
{

/// What samples of a run tell of the block: means before the pull and over it.
class BlockFigures
{
public:
  /// Takes in a sample, once the pressure is measured. @param time since the block is there [s]
  void look(const Pull &pull, const RubberBlockParameters &parameters, double time);

  /// @param top the pressure on the block's top [Pa]
  void add_to(Summary &summary, double top) const;

  double largest_overlap() const { return overlap; } ///< over the radius, of all samples

  void visit(StateVisitor &visit);

private:
  double n_held = 0., n_pulled = 0.;            // samples under all of the pressure; and at full speed
  double carried = 0.;                          // sum of the contacts' vertical force over weight and pressure
  double horizontal = 0., vertical = 0.;        // sums of the contacts' forces while it is pulled [N]
  double pulling = 0., mobilized = 0.;          // sums of the pulling force [N], and of the friction that is used up
  double front = 0.;                            // sum of the pressure on the foremost strip [Pa]
  double largest_front = 0., largest_face = 0.; // [Pa]
  double overlap = 0.;                          // the largest over the radius
};

} // namespace bergamo::driver
