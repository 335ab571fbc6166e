#pragma once

#include "drivers/common/command_line.h"
#include "drivers/common/forecast/forecast.h"
#include "drivers/common/parameter_file.h"

#include <functional>
#include <string>

namespace bergamo::driver
{

/// What a driver's program returns to the shell.
enum ExitStatus : int
{
  done = 0,
  run_failed = 1,
  user_mistake = 2,
  stopped_by_user = 130
};

/// The frame of every driver's main(): reads the command line, sets the number of OpenMP threads, starts deal.II (one
/// thread of its own), catches the signals that stop a run, runs the job, and turns exceptions into one message "error:
/// …" on standard error: ConfigError gives user_mistake, any other exception run_failed. Otherwise returns what the job
/// returns.
int run_driver(int argc, const char *const *argv, const DriverDescription &description,
               const std::function<int(const CommandLine &)> &job);

/// Runs what needs MPI (fe_dealii/equilibrium) within a session of it, and turns exceptions into a message there.
/// @throws ConfigError where MPI could not start
int run_with_mpi(const std::function<int()> &job);

/// Reads the parameter files in the order given, each over those before it, and then the --set options of the command
/// line. Returns false when only the defaults or the explanation of some were
/// asked for; they are then on standard output. Throws ConfigError for the user's mistakes.
bool read_parameters(ParameterFile &parameters, const CommandLine &command_line);

/// The command line with what is unusual in the parameters, which is also told on standard error.
/// @param further warnings of the driver
CommandLine warned_of(const ParameterFile &parameters, const CommandLine &command_line,
                      const std::vector<std::string> &further = {});

/// Tells what a run would be on standard output. @return done
int tell(const Forecast &forecast, const CommandLine &command_line);

/// The job of most drivers: reads and checks its parameters, then has a Job made of them go. A set of Parameters has
/// declare(), validate(), forecast() for --dry-run, where some values are unwise beside others advice(), a line for
/// each, and where some of them ask for MPI needs_mpi(), see run_with_mpi(); a Job is made of it, the command line and
/// the resolved text of the parameters, and its go() gives the exit status. @param title first line of the parameter
/// file
template <class Parameters, class Job>
int run_job(const std::string &title, const CommandLine &command_line)
{
  Parameters parameters;
  ParameterFile file(title);
  parameters.declare(file);
  if (!read_parameters(file, command_line))
    return done;
  parameters.validate();
  std::vector<std::string> further;
  if constexpr (requires { parameters.advice(); })
    further = parameters.advice();
  const CommandLine warned = warned_of(file, command_line, further);
  if (command_line.dry_run)
    return tell(parameters.forecast(), command_line);
  const auto go = [&] { return Job(parameters, warned, file.resolved_text()).go(); };
  if constexpr (requires { parameters.needs_mpi(); })
    return parameters.needs_mpi() ? run_with_mpi(go) : go();
  else
    return go();
}

} // namespace bergamo::driver
