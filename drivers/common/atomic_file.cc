#include "drivers/common/atomic_file.h"

#include "dem/core/error.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

namespace bergamo::driver
{

namespace
{

namespace fs = std::filesystem;
using dem::RunError;

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

/// A file descriptor that closes itself.
class Descriptor
{
public:
  explicit Descriptor(const int number) : number(number) {}
  ~Descriptor()
  {
    if (number >= 0)
      ::close(number);
  }
  Descriptor(const Descriptor &) = delete;
  Descriptor &operator=(const Descriptor &) = delete;
  const int number;
};

void write_all(const int descriptor, std::string_view text, const fs::path &path)
{
  while (!text.empty())
  {
    const ssize_t n_written = ::write(descriptor, text.data(), text.size());
    if (n_written < 0 && errno == EINTR)
      continue;
    if (n_written < 0)
      throw RunError(file_error("write", path, errno));
    text.remove_prefix(static_cast<std::size_t>(n_written));
  }
}

/// Brings a file or a folder to disk. File systems that cannot do so for a folder are no error.
void synchronise(const fs::path &path, const bool is_folder)
{
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  const bool failed = file.number < 0 || ::fsync(file.number) != 0;
  if (failed && !is_folder)
    throw RunError(file_error("write", path, errno));
}

} // namespace

std::string file_error(const std::string &action, const fs::path &path, const int error_number)
{
  return "cannot " + action + " '" + path.string() + "': " + std::generic_category().message(error_number) + "; " +
         remedy(error_number);
}

void write_atomically(const fs::path &path, const std::function<void(const fs::path &part)> &write)
{
  fs::path part = path;
  part += ".part";
  try
  {
    write(part);
    synchronise(part, false);
    if (::rename(part.c_str(), path.c_str()) != 0)
      throw RunError(file_error("write", path, errno));
  }
  catch (...)
  {
    std::error_code ignored;
    fs::remove(part, ignored);
    throw;
  }
  synchronise(path.has_parent_path() ? path.parent_path() : fs::path("."), true);
}

void write_atomically(const fs::path &path, const std::string_view text)
{
  write_atomically(path,
                   [&](const fs::path &part)
                   {
                     const Descriptor file(::open(part.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666));
                     if (file.number < 0)
                       throw RunError(file_error("write", path, errno));
                     write_all(file.number, text, path);
                   });
}

} // namespace bergamo::driver
