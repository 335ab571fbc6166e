#include "drivers/common/mpi_start.h"

#include "dem/core/error.h"

#include <sys/resource.h>

namespace bergamo::driver
{
namespace
{

constexpr rlim_t files_of_mpi = 64; // Open MPI 4.1 with its components takes some 30

} // namespace

void require_mpi_can_start()
{
  rlimit files = {};
  if (::getrlimit(RLIMIT_NOFILE, &files) == 0 && files.rlim_cur < files_of_mpi)
    reject("MPI, which this driver needs, opens more than the ", files.rlim_cur, " files that are allowed; allow ",
           files_of_mpi, " with 'ulimit -n ", files_of_mpi, "'");
}

} // namespace bergamo::driver
