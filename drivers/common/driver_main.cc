#include "drivers/common/driver_main.h"

#include "dem/core/error.h"
#include "drivers/common/dealii_start.h"
#include "drivers/common/forecast/forecast_text.h"
#include "drivers/common/interrupt.h"
#include "drivers/common/mpi_start.h"
#include "drivers/common/parameter_advice.h"
#include "drivers/common/parameter_help.h"
#include "fe_dealii/mpi_session.h"

#include <omp.h>

#include <exception>
#include <iostream>
#include <new>
#include <stdexcept>

namespace bergamo::driver
{

namespace
{

int report(const std::string &message, const int status)
{
  std::cout.flush();
  std::cerr << "error: " << message << std::endl;
  return status;
}

/// The job's status, or the one of the exception that ended it.
int guarded(const std::function<int()> &job)
{
  try
  {
    const int status = job();
    if (!std::cout.flush())
      return report("cannot write to standard output", run_failed);
    return status;
  }
  catch (const ConfigError &error)
  {
    return report(error.what(), user_mistake);
  }
  catch (const std::bad_alloc &)
  {
    return report("out of memory; use fewer particles or a coarser mesh", run_failed);
  }
  catch (const std::exception &error)
  {
    return report(error.what(), run_failed);
  }
}

} // namespace

int run_driver(const int argc, const char *const *const argv, const DriverDescription &description,
               const std::function<int(const CommandLine &)> &job)
{
  return guarded(
      [&]
      {
        const auto command_line = parse_command_line(argc, argv, description);
        if (!command_line)
          return static_cast<int>(done);
        start_dealii();
        if (command_line->threads)
          omp_set_num_threads(*command_line->threads);
        install_interrupt_handler();
        return job(*command_line);
      });
}

int run_with_mpi(const std::function<int()> &job)
{
  require_mpi_can_start();
  char program[] = "bergamo";
  char *words[] = {program, nullptr};
  char **argv = words;
  int argc = 1;
  const fe::MpiSession mpi(argc, argv);
  return guarded(job); // inside, so that MPI ends after the message
}

namespace
{

void read_files_and_settings(ParameterFile &parameters, const CommandLine &command_line)
{
  for (const std::filesystem::path &file : command_line.parameter_files)
    parameters.read(file);
  for (const std::string &setting : command_line.settings)
    parameters.set(setting);
}

/// A mistake in the files does not keep from the explanation, which may be what mends it.
void explain(ParameterFile &parameters, const CommandLine &command_line)
{
  std::exception_ptr mistake;
  try
  {
    read_files_and_settings(parameters, command_line);
  }
  catch (const ConfigError &)
  {
    mistake = std::current_exception();
  }
  std::cout << explained(parameters.entries(), command_line.help_topic);
  if (mistake)
    std::rethrow_exception(mistake);
}

} // namespace

bool read_parameters(ParameterFile &parameters, const CommandLine &command_line)
{
  if (!command_line.help_topic.empty() && !command_line.print_parameters)
  {
    explain(parameters, command_line);
    return false;
  }
  read_files_and_settings(parameters, command_line);
  if (command_line.print_parameters)
    std::cout << parameters.resolved_text();
  return !command_line.print_parameters;
}

int tell(const Forecast &forecast, const CommandLine &command_line)
{
  std::cout << text_of(forecast, command_line.output, room_for(command_line.output));
  return done;
}

CommandLine warned_of(const ParameterFile &parameters, const CommandLine &command_line,
                      const std::vector<std::string> &further)
{
  CommandLine warned = command_line;
  warned.warnings = unusual_values(parameters.entries());
  warned.warnings.insert(warned.warnings.end(), further.begin(), further.end());
  for (const std::string &warning : warned.warnings)
    std::cerr << "warning: " << warning << '\n';
  return warned;
}

} // namespace bergamo::driver
