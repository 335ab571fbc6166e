#include "drivers/common/run_folder.h"

#include "dem/core/error.h"
#include "dem/core/file_error.h"
#include "drivers/common/command_line.h"
#include "drivers/common/folder_probe.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <utility>

namespace bergamo::driver
{

namespace
{

namespace fs = std::filesystem;

const char *const previous_run = "previous_run";

bool is_part(const std::string &name)
{
  return name.ends_with(".partial") || name.ends_with(".part"); // of the programs and of the plot scripts
}

/// NAME_0000.vtu, of the models' pictures.
bool is_picture(const std::string &name)
{
  if (!name.ends_with(".vtu"))
    return false;
  const std::string stem = name.substr(0, name.size() - 4);
  const std::size_t last = stem.find_last_not_of("0123456789"); // before the number
  return last != std::string::npos && last > 0 && stem[last] == '_' && stem.size() - last > 4;
}

/// Whether every driver writes a file or folder of this name.
bool is_of_a_run(const std::string &name)
{
  return name == "parameters.prm" || name == "history.csv" || name == "summary.json" || name == "snapshot.h5" ||
         name == "plots" || name.ends_with(".pvd") || is_picture(name);
}

/// The folder itself, or the nearest one above it that exists.
fs::path nearest_existing(fs::path path)
{
  path = fs::absolute(path);
  std::error_code ignored;
  while (!fs::exists(path, ignored) && path.has_relative_path())
    path = path.parent_path();
  return path;
}

void check_writable(const fs::path &folder)
{
  const fs::path existing = nearest_existing(folder);
  std::error_code ignored;
  if (!fs::is_directory(existing, ignored))
    throw ConfigError("output folder '" + folder.string() + "' cannot be made: '" + existing.string() +
                      "' is a file; choose another folder with --output");
  if (!can_make_folder_in(existing))
    throw ConfigError(
        file_error(existing == fs::absolute(folder) ? "write to output folder" : "make output folder", folder, errno));
}

std::vector<fs::path> content(const fs::path &folder)
{
  std::vector<fs::path> paths;
  try
  {
    for (const auto &entry : fs::directory_iterator(folder))
      paths.push_back(entry.path());
  }
  catch (const fs::filesystem_error &error)
  {
    throw RunError(file_error("read folder", folder, error.code().value()));
  }
  return paths;
}

void move_aside(const fs::path &folder, const std::vector<std::string> &own)
{
  const auto is_own = [&](const std::string &name) { return std::find(own.begin(), own.end(), name) != own.end(); };
  std::vector<fs::path> old_files;
  for (const fs::path &path : content(folder))
    if (const std::string name = path.filename().string(); is_of_a_run(name) || is_own(name))
      old_files.push_back(path);
  if (old_files.empty())
    return;
  fs::remove_all(folder / previous_run);
  fs::create_directory(folder / previous_run);
  for (const fs::path &path : old_files)
    fs::rename(path, folder / previous_run / path.filename());
}

void remove_parts(const fs::path &folder)
{
  for (const fs::path &path : content(folder))
    if (is_part(path.filename().string()))
      fs::remove(path);
}

FolderMode mode_of(const CommandLine &command_line)
{
  if (command_line.restart)
    return FolderMode::restart;
  return command_line.force ? FolderMode::force : FolderMode::fresh;
}

} // namespace

RunFolder::RunFolder(fs::path path, const FolderMode mode, std::vector<std::string> own)
    : folder(std::move(path)), mode(mode), own(std::move(own))
{
  check_writable(folder);
  std::error_code ignored;
  if (fs::exists(folder, ignored))
    keep_others_out();
  require_empty();
  if (mode == FolderMode::restart && !fs::exists(folder / "snapshot.h5", ignored))
    throw ConfigError("--restart finds no snapshot.h5 in '" + folder.string() +
                      "'; check --output, or begin a new run without --restart");
}

RunFolder::RunFolder(const CommandLine &command_line, std::vector<std::string> own)
    : RunFolder(command_line.output, mode_of(command_line), std::move(own))
{
}

RunFolder::Descriptor::~Descriptor()
{
  if (number >= 0)
    ::close(number);
}

RunFolder::Descriptor &RunFolder::Descriptor::operator=(Descriptor &&other) noexcept
{
  std::swap(number, other.number);
  return *this;
}

void RunFolder::keep_others_out()
{
  lock = Descriptor(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (lock.number < 0)
    throw RunError(file_error("open folder", folder, errno));
  if (::flock(lock.number, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
    throw ConfigError("another run is writing to '" + folder.string() +
                      "'; wait for its end, or choose another folder with --output");
}

void RunFolder::require_empty() const
{
  std::error_code ignored;
  if (mode == FolderMode::fresh && fs::exists(folder, ignored) && !content(folder).empty())
    throw ConfigError("output folder '" + folder.string() +
                      "' is not empty; choose another one with --output, go on with the run in it with --restart, or "
                      "begin anew with --force (the run in it then moves to its sub-folder previous_run)");
}

void RunFolder::open()
{
  try
  {
    fs::create_directories(folder);
    if (lock.number < 0) // the folder is new; another run may have made it, and have ended, since the constructor
      keep_others_out();
    require_empty();
    if (mode == FolderMode::force)
      move_aside(folder, own);
    remove_parts(folder);
  }
  catch (const fs::filesystem_error &error)
  {
    throw RunError(file_error("prepare output folder", folder, error.code().value()));
  }
}

} // namespace bergamo::driver
