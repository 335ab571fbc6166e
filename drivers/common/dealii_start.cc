#include "drivers/common/dealii_start.h"

#include <deal.II/base/exceptions.h>
#include <deal.II/base/multithread_info.h>

namespace bergamo::driver
{

void start_dealii()
{
  dealii::deal_II_exceptions::disable_abort_on_exception();
  dealii::MultithreadInfo::set_thread_limit(1);
}

} // namespace bergamo::driver
