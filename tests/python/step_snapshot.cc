// Steps a simulation that Python has saved, from C++: step_snapshot SNAPSHOT STEPS THREADS makes twice so many steps
// and prints the seconds that the second half took, by the clock and of the processor, and the hash of the state after
// it.

#include "drivers/python/engine/saved_simulation.h"

#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <iostream>
#include <omp.h>

int main(int n_arguments, char *arguments[])
{
  if (n_arguments != 4)
  {
    std::cerr << "Usage: step_snapshot SNAPSHOT STEPS THREADS\n";
    return 2;
  }
  try
  {
    omp_set_num_threads(std::atoi(arguments[3]));
    const auto simulation = bergamo::python::load(arguments[1]);
    const std::int64_t n_steps = std::atoll(arguments[2]);
    for (std::int64_t n = 0; n < n_steps; ++n)
      simulation->step();
    const auto begin = std::chrono::steady_clock::now();
    const std::clock_t begin_of_work = std::clock();
    for (std::int64_t n = 0; n < n_steps; ++n)
      simulation->step();
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
    const double work = static_cast<double>(std::clock() - begin_of_work) / CLOCKS_PER_SEC;
    std::cout << seconds.count() << ' ' << work << ' ' << state_hash(*simulation) << '\n';
  }
  catch (const std::exception &error)
  {
    std::cerr << "error: " << error.what() << '\n';
    return 1;
  }
}
