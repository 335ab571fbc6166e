#include "drivers/common/mpi_start.h"

#include "dem/core/error.h"
#include "drivers/common/folder_probe.h"

#include <sys/resource.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>
#include <utility>

namespace bergamo::driver
{
namespace
{

constexpr rlim_t files_of_mpi = 64; // Open MPI 4.1 with its components takes some 30

/// The name of the variable that sets Open MPI's folder, and the folder.
std::pair<std::string, std::string> folder_of_mpi()
{
  for (const char *name : {"TMPDIR", "TEMP", "TMP"})
    if (const char *folder = std::getenv(name); folder != nullptr)
      return {name, folder};
  return {"TMPDIR", "/tmp"};
}

} // namespace

void require_mpi_can_start()
{
  const auto [name, folder] = folder_of_mpi();
  if (!can_make_folder_in(folder))
    reject("MPI, which this driver needs, cannot make its folder in '", folder, "': ", std::strerror(errno), "; set ",
           name, " to a folder that can be written");
  rlimit files = {};
  if (::getrlimit(RLIMIT_NOFILE, &files) == 0 && files.rlim_cur < files_of_mpi)
    reject("MPI, which this driver needs, opens more than the ", files.rlim_cur, " files that are allowed; allow ",
           files_of_mpi, " with 'ulimit -n ", files_of_mpi, "'");
}

} // namespace bergamo::driver
