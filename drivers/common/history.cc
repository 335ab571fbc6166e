#include "drivers/common/history.h"

#include "dem/core/error.h"
#include "dem/core/file_error.h"
#include "dem/core/whole_file.h"
#include "drivers/common/number_text.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <stdexcept>
#include <utility>

namespace bergamo::driver
{

namespace
{

std::string header_of(const std::vector<std::string> &columns)
{
  std::string header;
  for (const std::string &column : columns)
    header += (header.empty() ? "" : ",") + column;
  return header + "\n";
}

void check_columns(const std::vector<std::string> &columns)
{
  if (columns.empty() || columns[0] != "time_s")
    throw std::logic_error("the first column of a history is time_s");
  for (std::size_t i = 0; i < columns.size(); ++i)
  {
    if (columns[i].empty() || columns[i].find_first_of(", \t\n\"") != std::string::npos)
      throw std::logic_error("'" + columns[i] + "' is no name of a history's column");
    if (std::find(columns.begin(), columns.begin() + i, columns[i]) != columns.begin() + i)
      throw std::logic_error("a history has two columns '" + columns[i] + "'");
  }
}

/// The header and the complete rows with time <= last_time.
std::string kept_text(const std::filesystem::path &path, const std::vector<std::string> &columns,
                      const double last_time)
{
  std::ifstream file(path);
  if (!file)
    throw ConfigError("'" + path.string() +
                      "' cannot be read, so the run cannot go on with it; put the file back, or "
                      "begin a new run without --restart");
  std::string text, line;
  for (int number = 1; std::getline(file, line) && !file.eof(); ++number) // a last line without its end is not kept
  {
    line += '\n';
    if (number == 1)
    {
      if (line != header_of(columns))
        throw ConfigError("'" + path.string() +
                          "' has other columns than this run writes; go on with the program and "
                          "the parameters that began it, or begin a new run without --restart");
      text = line;
      continue;
    }
    const auto time = parse_number(line.substr(0, line.find(',')));
    const auto n_commas = static_cast<std::size_t>(std::count(line.begin(), line.end(), ','));
    if (!time || n_commas + 1 != columns.size())
      throw RunError("'" + path.string() + "' is damaged in line " + std::to_string(number) +
                     "; remove that line, or begin a new run without --restart");
    if (*time <= last_time)
      text += line;
  }
  return text.empty() ? header_of(columns) : text;
}

} // namespace

History::History(std::filesystem::path path, std::vector<std::string> columns)
    : path(std::move(path)), columns(std::move(columns))
{
  check_columns(this->columns);
  write_whole_file(this->path, header_of(this->columns));
  open();
}

History::History(Existing, std::filesystem::path path, std::vector<std::string> columns)
    : path(std::move(path)), columns(std::move(columns))
{
  open();
}

History History::continued(std::filesystem::path path, std::vector<std::string> columns, const double last_time)
{
  check_columns(columns);
  write_whole_file(path, kept_text(path, columns, last_time));
  return {Existing(), std::move(path), std::move(columns)};
}

History::History(History &&other) noexcept
    : path(std::move(other.path)), columns(std::move(other.columns)), descriptor(std::exchange(other.descriptor, -1))
{
}

History::~History()
{
  if (descriptor >= 0)
    ::close(descriptor);
}

void History::open()
{
  descriptor = ::open(path.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
  if (descriptor < 0)
    throw RunError(file_error("write", path, errno));
}

void History::append(const std::span<const double> row)
{
  if (row.size() != columns.size())
    throw std::logic_error("a row of " + std::to_string(row.size()) + " numbers for " + std::to_string(columns.size()) +
                           " columns of a history");
  std::string text;
  for (const double number : row)
    text += (text.empty() ? "" : ",") + exact_text(number);
  text += '\n';
  for (std::string_view rest = text; !rest.empty();)
  {
    const ssize_t n_written = ::write(descriptor, rest.data(), rest.size());
    if (n_written < 0 && errno == EINTR)
      continue;
    if (n_written < 0)
      throw RunError(file_error("write", path, errno));
    rest.remove_prefix(static_cast<std::size_t>(n_written));
  }
}

} // namespace bergamo::driver
