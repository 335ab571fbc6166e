#include "drivers/python/engine/team.h"

#include "dem/core/error.h"

#include <omp.h>

namespace bergamo::python
{
namespace
{

int chosen = 0; // guarded by Python's lock, as all calls here are made with it

} // namespace

void set_team(const int n_threads)
{
  require(n_threads >= 1, "number of threads", n_threads, "at least 1");
  chosen = n_threads;
}

int team()
{
  return chosen > 0 ? chosen : omp_get_max_threads();
}

void take_team()
{
  if (chosen > 0)
    omp_set_num_threads(chosen);
}

} // namespace bergamo::python
