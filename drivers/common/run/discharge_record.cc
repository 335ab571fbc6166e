#include "drivers/common/run/discharge_record.h"

#include <algorithm>
#include <cassert>

namespace bergamo::driver
{

void DischargeRecord::look(const double time, const dem::Particles &grains, const dem::Throughput &removed)
{
  assert(times_.empty() || time > times_.back());
  dem::Throughput passed = removed;
  for (std::size_t i = 0; i < grains.size(); ++i)
    if (!grains.is_fixed(i) && behind.normal.dot(grains.position[i]) <= behind.offset)
      passed.count(grains, i);
  // A grain that bounces back through the orifice has passed all the same: the record never falls.
  const double mass = std::max(masses_.empty() ? 0. : masses_.back(), passed.mass);
  if (passed.n_grains > n_grains_)
  {
    n_grains_ = passed.n_grains;
    last_passage = time;
  }
  times_.push_back(time);
  masses_.push_back(mass);
}

double DischargeRecord::flow() const
{
  const std::size_t n = times_.size();
  return n < 2 ? 0. : (masses_[n - 1] - masses_[n - 2]) / (times_[n - 1] - times_[n - 2]);
}

std::vector<Column> DischargeRecord::columns() const
{
  return {{"discharged_mass_kg", [this] { return mass(); }},
          {"discharged_grains", [this] { return static_cast<double>(n_grains_); }},
          {"mass_flow_kg_s", [this] { return flow(); }}};
}

void DischargeRecord::visit(StateVisitor &visit)
{
  visit("discharge/times", times_);
  visit("discharge/masses", masses_);
  visit("discharge/n_grains", n_grains_);
  visit("discharge/last_passage", last_passage);
}

} // namespace bergamo::driver
