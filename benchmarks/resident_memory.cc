#include "benchmarks/resident_memory.h"

#include <unistd.h>

#include <fstream>

namespace bergamo::benchmark
{

double resident_memory()
{
  std::ifstream file("/proc/self/statm");
  double total = 0., resident = 0.;
  file >> total >> resident;
  return resident * sysconf(_SC_PAGESIZE);
}

} // namespace bergamo::benchmark
