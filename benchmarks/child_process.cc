#include "benchmarks/child_process.h"

#include "dem/core/error.h"

#include <array>
#include <cstdio>
#include <cstdlib>
#include <sstream>
#include <sys/wait.h>
#include <unistd.h>

namespace bergamo::benchmark
{
namespace
{

namespace fs = std::filesystem;

[[noreturn]] void reject_output(const std::string &key)
{
  throw RunError("the program printed no '" + key + "': this version of it is unknown here; leave it out");
}

std::string last_words(const std::string &text)
{
  constexpr std::size_t longest = 600;
  const std::size_t from = text.size() > longest ? text.size() - longest : 0;
  const auto error = text.find("ERROR");
  return text.substr(error == std::string::npos ? from : error);
}

} // namespace

TemporaryFolder::TemporaryFolder(const std::string &name)
{
  std::string path = (fs::temp_directory_path() / (name + "_XXXXXX")).string();
  if (!mkdtemp(path.data()))
    throw RunError("cannot make the folder " + path + "; set TMPDIR to a folder you may write to");
  folder = path;
}

TemporaryFolder::~TemporaryFolder()
{
  std::error_code ignored;
  fs::remove_all(folder, ignored);
}

std::optional<fs::path> find_program(const std::string &program)
{
  const auto is_program = [](const fs::path &path)
  {
    std::error_code ignored;
    return fs::is_regular_file(path, ignored) && access(path.c_str(), X_OK) == 0;
  };
  if (program.find('/') != std::string::npos)
    return is_program(program) ? std::optional(fs::absolute(program)) : std::nullopt;
  const char *const path = std::getenv("PATH");
  std::istringstream folders(path ? path : "/usr/bin");
  for (std::string folder; std::getline(folders, folder, ':');)
    if (is_program(fs::path(folder) / program))
      return fs::absolute(fs::path(folder) / program);
  return std::nullopt;
}

std::string quoted(const fs::path &path)
{
  std::string text = "'";
  for (const char c : path.string())
    text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

std::string output_of(const fs::path &program, const std::string &arguments, const fs::path &folder)
{
  const std::string command = "cd " + quoted(folder) +
                              " && OMP_NUM_THREADS=1 OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 " +
                              quoted(program) + ' ' + arguments + " 2>&1 < /dev/null";
  FILE *const pipe = popen(command.c_str(), "r");
  if (!pipe)
    throw RunError("cannot start " + program.string() + "; leave it out");
  std::string output;
  std::array<char, 4096> buffer;
  while (const std::size_t n = fread(buffer.data(), 1, buffer.size(), pipe))
    output.append(buffer.data(), n);
  const int status = pclose(pipe);
  if (status != 0)
    throw RunError(program.string() + " failed with status " +
                   std::to_string(WIFEXITED(status) ? WEXITSTATUS(status) : status) + ": " + last_words(output) +
                   "\nsee to it, or leave the program out");
  return output;
}

double number_after(const std::string &text, const std::string &key)
{
  const auto at = text.rfind(key);
  if (at == std::string::npos)
    reject_output(key);
  return std::strtod(text.c_str() + at + key.size(), nullptr);
}

std::string part_after(const std::string &text, const std::string &key, const int n)
{
  std::size_t begin = 0;
  for (int i = 0; i <= n && begin != std::string::npos; ++i)
    begin = text.find(key, i == 0 ? 0 : begin + key.size());
  if (begin == std::string::npos)
    reject_output(key);
  return text.substr(begin, text.find(key, begin + key.size()) - begin);
}

} // namespace bergamo::benchmark
