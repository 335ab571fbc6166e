#include "drivers/common/run/run_cost.h"

#include <ctime>

namespace bergamo::driver
{

double processor_time()
{
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

void RunCost::step_on()
{
  since_ = clock_();
  is_stepping_ = true;
}

void RunCost::pause()
{
  stepped_ = stepping_seconds();
  is_stepping_ = false;
}

double RunCost::stepping_seconds() const
{
  return is_stepping_ ? stepped_ + clock_() - since_ : stepped_;
}

void RunCost::visit(StateVisitor &visit)
{
  double spent = core_seconds(), stepped = stepping_seconds();
  visit("core_seconds", spent);
  visit("stepping_seconds", stepped);
  if (!visit.is_reading())
    return;
  earlier_ = spent; // reading it is of this process
  stepped_ = stepped;
}

} // namespace bergamo::driver
