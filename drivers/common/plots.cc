#include "drivers/common/plots.h"

#include "drivers/common/interrupt.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <sstream>

namespace bergamo::driver
{

namespace
{

constexpr const char *python = "/usr/bin/python3";
constexpr std::chrono::minutes time_limit(5);

struct Pipe
{
  int read_end = -1, write_end = -1;
  Pipe()
  {
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) == 0)
    {
      read_end = ends[0];
      write_end = ends[1];
    }
  }
  ~Pipe()
  {
    close_end(read_end);
    close_end(write_end);
  }
  Pipe(const Pipe &) = delete;
  Pipe &operator=(const Pipe &) = delete;
  static void close_end(int &end)
  {
    if (end >= 0)
      ::close(end);
    end = -1;
  }
};

/// Starts a program as the head of its own process group. Returns its number, or a negative error number.
pid_t start(const std::vector<std::string> &command, const Pipe &out, const Pipe &err)
{
  std::vector<char *> arguments;
  for (const std::string &word : command)
    arguments.push_back(const_cast<char *>(word.c_str()));
  arguments.push_back(nullptr);

  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, out.write_end, STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, err.write_end, STDERR_FILENO);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  pid_t process = 0;
  const int failure = ::posix_spawn(&process, arguments[0], &actions, &attributes, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  posix_spawnattr_destroy(&attributes);
  return failure == 0 ? process : -failure;
}

/// Collects what comes out of a pipe now; false once it has been closed.
bool drain(int &end, std::string &text)
{
  std::array<char, 4096> buffer;
  const ssize_t n_read = ::read(end, buffer.data(), buffer.size());
  if (n_read > 0)
    text.append(buffer.data(), static_cast<std::size_t>(n_read));
  if (n_read == 0 || (n_read < 0 && errno != EINTR))
    Pipe::close_end(end);
  return end >= 0;
}

struct Outcome
{
  std::string out, err;
  std::string failure; ///< empty when the program ended well
};

/// Follows a program to its end, or ends it and its children when its time is over or the user stops the run.
Outcome follow(const pid_t process, Pipe &out, Pipe &err)
{
  Outcome outcome;
  const auto deadline = std::chrono::steady_clock::now() + time_limit;
  while (out.read_end >= 0 || err.read_end >= 0)
  {
    std::array<pollfd, 2> ends = {pollfd{out.read_end, POLLIN, 0}, pollfd{err.read_end, POLLIN, 0}};
    ::poll(ends.data(), ends.size(), 200);
    if (ends[0].revents != 0)
      drain(out.read_end, outcome.out);
    if (ends[1].revents != 0)
      drain(err.read_end, outcome.err);
    if (interrupted())
      outcome.failure = "stopped by the user";
    else if (std::chrono::steady_clock::now() > deadline)
      outcome.failure = "took longer than five minutes";
    if (!outcome.failure.empty())
    {
      ::kill(-process, SIGTERM);
      break;
    }
  }
  int status = 0;
  while (::waitpid(process, &status, 0) < 0 && errno == EINTR)
    continue;
  if (outcome.failure.empty() && !(WIFEXITED(status) && WEXITSTATUS(status) == 0))
    outcome.failure = WIFEXITED(status) ? "exit status " + std::to_string(WEXITSTATUS(status)) : "ended by a signal";
  return outcome;
}

std::string last_line(const std::string &text)
{
  std::string last;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);)
    if (!line.empty())
      last = line;
  return last;
}

std::filesystem::path path_of(const std::filesystem::path &script)
{
  const std::filesystem::path drivers = std::filesystem::path(BERGAMO_SOURCE_DIR) / "drivers";
  return script.has_parent_path() ? drivers / script : drivers / "common/plots" / script;
}

Outcome run(const std::vector<std::string> &command)
{
  Pipe out, err;
  if (out.read_end < 0 || err.read_end < 0)
    return {"", "", "no pipe to be had: " + std::string(std::strerror(errno))};
  const pid_t process = start(command, out, err);
  if (process < 0)
    return {"", "", std::string(python) + ": " + std::strerror(-process)};
  Pipe::close_end(out.write_end);
  Pipe::close_end(err.write_end);
  return follow(process, out, err);
}

} // namespace

PlotResult make_plots(const std::vector<PlotJob> &jobs)
{
  const InterruptWatch watch;
  PlotResult result;
  for (const PlotJob &job : jobs)
  {
    if (interrupted())
      break;
    std::vector<std::string> command = {python, "-B",
                                        path_of(job.script).string()}; // -B: no byte code in the source folder
    command.insert(command.end(), job.arguments.begin(), job.arguments.end());
    const Outcome outcome = run(command);
    if (!outcome.failure.empty())
    {
      const std::string reason = last_line(outcome.err);
      result.warnings.push_back("picture of " + job.script + " not drawn (" + outcome.failure + ")" +
                                (reason.empty() ? "" : ": " + reason));
    }
    std::istringstream names(outcome.out);
    for (std::string name; std::getline(names, name);)
      if (std::filesystem::exists(name))
        result.pictures.emplace_back(name);
  }
  return result;
}

} // namespace bergamo::driver
