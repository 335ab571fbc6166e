#include "dem/core/file_error.h"

#include <cerrno>
#include <system_error>

namespace bergamo
{

namespace
{

std::string remedy(const int error_number)
{
  switch (error_number)
  {
  case ENOSPC:
  case EDQUOT:
  case EFBIG:
    return "free some space, raise the limit on file sizes or choose another output folder";
  case EACCES:
  case EPERM:
  case EROFS:
    return "choose an output folder that you may write to";
  case ENOENT:
  case ENOTDIR:
    return "create the folder first or choose another one";
  case EISDIR:
    return "choose a name that is no folder";
  default:
    return "look after the disk or choose another output folder";
  }
}

} // namespace

std::string file_error(const std::string &action, const std::filesystem::path &path, const int error_number)
{
  return "cannot " + action + " " + path.string() + ": " + std::system_category().message(error_number) + "; " +
         remedy(error_number);
}

} // namespace bergamo
