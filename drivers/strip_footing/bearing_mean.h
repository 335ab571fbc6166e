#pragma once

#include "drivers/common/run/state_visitor.h"
#include "drivers/common/summary.h"

#include <algorithm>
#include <limits>

namespace bergamo::driver
{

/// Mean of the footing's pressure over the time in which the ground flows, and how far it wanders; and its peak over
/// all time, which dense sand has before that.
class BearingMean
{
public:
  void see(const double pressure, const double settlement) // [Pa], [m]
  {
    if (pressure <= peak_)
      return;
    peak_ = pressure;
    peak_settlement_ = settlement;
  }
  void add(const double pressure, const double time_step) // [Pa], [s]
  {
    impulse_ += pressure * time_step;
    time_ += time_step;
    lowest_ = std::min(lowest_, pressure);
    highest_ = std::max(highest_, pressure);
  }

  double mean() const { return impulse_ / time_; } ///< [Pa]

  void add_figures(Summary &summary) const
  {
    summary.set("bearing_pressure_Pa", mean(), "Pa");
    summary.set("bearing_pressure_lowest_Pa", lowest_, "Pa");
    summary.set("bearing_pressure_highest_Pa", highest_, "Pa");
    summary.set("peak_pressure_Pa", peak_, "Pa");
    summary.set("peak_settlement_m", peak_settlement_, "m");
  }

  void visit(StateVisitor &visit)
  {
    visit("bearing/impulse", impulse_);
    visit("bearing/time", time_);
    visit("bearing/lowest", lowest_);
    visit("bearing/highest", highest_);
    visit("bearing/peak", peak_);
    visit("bearing/peak_settlement", peak_settlement_);
  }

private:
  double impulse_ = 0, time_ = 0; // [Pa s, s]
  double lowest_ = std::numeric_limits<double>::infinity(), highest_ = -lowest_;
  double peak_ = highest_, peak_settlement_ = 0; // [Pa, m]
};

} // namespace bergamo::driver
