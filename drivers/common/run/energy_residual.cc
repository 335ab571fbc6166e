#include "drivers/common/run/energy_residual.h"

#include <algorithm>
#include <cmath>

namespace bergamo::driver
{

double EnergyResidual::add(const double balance, const double work)
{
  if (n_samples_++ == 0)
    first_balance_ = balance;
  present_ = balance - first_balance_;
  largest_ = std::max(largest_, std::abs(present_));
  largest_work_ = std::max(largest_work_, std::abs(work));
  return present_;
}

void EnergyResidual::visit(StateVisitor &visit)
{
  visit("energy_residual/n_samples", n_samples_);
  visit("energy_residual/first_balance", first_balance_);
  visit("energy_residual/largest", largest_);
  visit("energy_residual/largest_work", largest_work_);
}

} // namespace bergamo::driver
