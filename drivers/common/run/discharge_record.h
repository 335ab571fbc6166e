#pragma once

#include "dem/flow/throughput.h"
#include "dem/packing/space.h"
#include "dem/state/particles.h"
#include "drivers/common/run/state_visitor.h"
#include "drivers/common/run/table.h"

#include <cstdint>
#include <vector>

namespace bergamo::driver
{

/// What has passed an orifice, sample by sample: grains behind a plane, and those that an outlet has taken away there.
class DischargeRecord
{
public:
  /// @param behind where grains are that have passed
  explicit DischargeRecord(const dem::HalfSpace &behind) : behind(behind) {}

  /// A sample. @param time of the discharge, later than the sample before [s]; @param removed by the outlet
  void look(double time, const dem::Particles &grains, const dem::Throughput &removed);

  const std::vector<double> &times() const { return times_; }   ///< of the samples, 0 without any grain before [s]
  const std::vector<double> &masses() const { return masses_; } ///< that had passed at most by then [kg]

  double mass() const { return masses_.empty() ? 0. : masses_.back(); } ///< [kg]
  std::int64_t n_grains() const { return n_grains_; }

  /// Mass since the sample before over the time since then [kg/s].
  double flow() const;

  /// Since anything has passed, or since the start [s].
  double quiet_time() const { return times_.empty() ? 0. : times_.back() - last_passage; }

  /// Mass, number and flow; must not outlive the record.
  std::vector<Column> columns() const;

  void visit(StateVisitor &visit);

private:
  dem::HalfSpace behind;
  std::vector<double> times_, masses_;
  std::int64_t n_grains_ = 0;
  double last_passage = 0.; // [s]
};

} // namespace bergamo::driver
