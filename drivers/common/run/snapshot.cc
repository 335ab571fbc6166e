#include "drivers/common/run/snapshot.h"

#include "dem/core/error.h"

#include <mutex>
#include <sstream>
#include <utility>

namespace bergamo::driver
{
namespace
{

/// HDF5 serves one thread at a time.
std::mutex archives;

std::string without_indent(const std::string &line)
{
  const auto begin = line.find_first_not_of(' ');
  return begin == std::string::npos ? "" : line.substr(begin);
}

/// The first line in which two parameter files differ.
std::string first_difference(const std::string &stored, const std::string &present)
{
  std::istringstream there(stored), here(present);
  std::string line_there, line_here;
  while (std::getline(there, line_there) && std::getline(here, line_here))
    if (line_there != line_here)
      return std::string("'") + without_indent(line_there) + "' there, '" + without_indent(line_here) + "' here";
  return "one file is longer";
}

} // namespace

Snapshot::Snapshot(std::filesystem::path path, std::string kind, std::string parameters, std::string remedy)
    : path_(std::move(path)), kind_(std::move(kind)), parameters_(std::move(parameters)), remedy_(std::move(remedy))
{
}

/// @return what puts it on the disk
std::function<void()> Snapshot::collect(const Visit &visit) const
{
  const std::lock_guard guard(archives);
  ArchiveWriter archive(path_, kind_);
  archive.write("parameters", parameters_);
  StateVisitor visitor(archive);
  visit(visitor);
  return archive.finish();
}

void Snapshot::write(const Visit &visit) const
{
  wait();
  collect(visit)();
}

void Snapshot::write_behind(const Visit &visit)
{
  wait();
  behind_ = std::async(std::launch::async, collect(visit));
}

void Snapshot::wait() const
{
  if (behind_.valid())
    behind_.get();
}

void Snapshot::read(const Visit &visit) const
{
  wait();
  const std::lock_guard guard(archives);
  const ArchiveReader archive(path_, kind_);
  const std::string stored = archive.read_text("parameters");
  if (stored != parameters_)
    throw ConfigError("the snapshot " + path_.string() + " belongs to other parameters (" +
                      first_difference(stored, parameters_) + "); " + remedy_);
  StateVisitor visitor(archive);
  visit(visitor);
}

} // namespace bergamo::driver
