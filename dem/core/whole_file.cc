#include "dem/core/whole_file.h"

#include "dem/core/error.h"
#include "dem/core/file_error.h"

#include <cerrno>
#include <fcntl.h>
#include <system_error>
#include <unistd.h>

namespace bergamo
{

WholeFile::WholeFile(std::filesystem::path path) : path_(std::move(path)), partial_(path_)
{
  partial_ += ".partial";
  std::error_code ignored;
  if (std::filesystem::is_directory(path_, ignored))
    fail(EISDIR);
  descriptor_ = ::open(partial_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (descriptor_ < 0)
    fail(errno);
}

WholeFile::~WholeFile()
{
  if (descriptor_ < 0)
    return;
  ::close(descriptor_);
  ::unlink(partial_.c_str());
}

void WholeFile::write(const void *bytes, std::size_t size)
{
  const char *next = static_cast<const char *>(bytes);
  while (size > 0)
  {
    const ssize_t written = ::write(descriptor_, next, size);
    if (written < 0 && errno == EINTR)
      continue;
    if (written <= 0)
      fail(written < 0 ? errno : EIO);
    next += written;
    size -= static_cast<std::size_t>(written);
  }
}

void WholeFile::commit()
{
  if (::fsync(descriptor_) != 0)
    fail(errno);
  if (::rename(partial_.c_str(), path_.c_str()) != 0)
    fail(errno);
  const int closed = ::close(descriptor_);
  const int reason = errno;
  descriptor_ = -1;
  if (closed != 0)
    fail(reason);

  // The new name reaches the disk with its folder. Some file systems cannot do it: the file itself is whole anyway.
  const std::filesystem::path folder = path_.has_parent_path() ? path_.parent_path() : std::filesystem::path(".");
  if (const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC); descriptor >= 0)
  {
    ::fsync(descriptor);
    ::close(descriptor);
  }
}

void WholeFile::fail(const int reason) const
{
  throw RunError(file_error("write", path_, reason) + ". A file of that name from before is unchanged.");
}

void write_whole_file(const std::filesystem::path &path, const std::string_view text)
{
  WholeFile file(path);
  file.write(text);
  file.commit();
}

} // namespace bergamo
