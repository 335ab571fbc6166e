#include "drivers/common/atomic_file.h"

#include "dem/core/whole_file.h"

#include <cerrno>
#include <system_error>

namespace bergamo::driver
{

namespace
{

namespace fs = std::filesystem;

std::string remedy(const int error_number)
{
  switch (error_number)
  {
  case ENOSPC:
  case EDQUOT:
  case EFBIG:
    return "free some space, or choose another folder with --output";
  case EACCES:
  case EPERM:
  case EROFS:
    return "choose a folder that you may write to with --output";
  case ENOENT:
  case ENOTDIR:
    return "check that the folder still exists";
  default:
    return "check the disk, or choose another folder with --output";
  }
}

} // namespace

std::string file_error(const std::string &action, const fs::path &path, const int error_number)
{
  return "cannot " + action + " '" + path.string() + "': " + std::generic_category().message(error_number) + "; " +
         remedy(error_number);
}

void write_atomically(const fs::path &path, const std::string_view text)
{
  dem::WholeFile file(path);
  file.write(text);
  file.commit();
}

} // namespace bergamo::driver
