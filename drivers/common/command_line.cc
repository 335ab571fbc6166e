#include "drivers/common/command_line.h"

#include "dem/core/error.h"
#include "drivers/common/nearest_name.h"

#include <CLI/CLI.hpp>
#include <omp.h>

#include <iostream>

namespace bergamo::driver
{

namespace
{

/// What stands behind --help: nothing, a topic, or, as of old, the parameter file that comes next.
void take_topic(const std::string &word, CommandLine &command_line)
{
  if (word.ends_with(".prm"))
    command_line.parameter_files.emplace_back(word);
  else
    command_line.help_topic = word;
}

void add_options(CLI::App &app, CommandLine &command_line)
{
  app.add_option("file.prm", command_line.parameter_files,
                 "Parameter file; where several are given, later ones win over earlier ones")
      ->type_name("");
  app.add_option("--set", command_line.settings, "Overrides one parameter of the files; may be given many times")
      ->type_name("\"Section/Name=value\"")
      ->expected(1)
      ->take_all()
      ->allow_extra_args(false);
  app.add_option("--threads", command_line.threads, "Number of threads (default: one a core, or OMP_NUM_THREADS)")
      ->type_name("N");
  app.add_option("--output", command_line.output,
                 "Folder of the run (default: results/<name of the first parameter file>)")
      ->type_name("DIR");
  app.add_flag("--force", command_line.force,
               "Take over a folder that holds an earlier run; that run's files move to DIR/previous_run");
  app.add_flag("--restart", command_line.restart, "Go on from the snapshot in the folder of the run");
  app.add_flag("--quiet", command_line.quiet, "Show no progress and no table of results");
  app.add_flag_callback(
      "--no-plots", [&command_line] { command_line.plots = false; }, "Draw no pictures at the end");
  app.add_flag("--dry-run", command_line.dry_run,
               "Tell grains, elements, steps, time, memory and disk of the run, then stop");
  app.add_flag("--print-parameters", command_line.print_parameters,
               "Write a commented parameter file with the values in force, defaults where none is given, to standard "
               "output");
}

std::string footer(const std::string &name)
{
  const std::string begin = "  " + name + " "; // of commands that hold for every driver, whatever its parameters are
  return "Examples:\n" + begin + "--print-parameters > my.prm\n" + begin + "my.prm --help Section/Name\n" + begin +
         name + ".prm my.prm\n" + begin +
         "my.prm --set \"Section/Name=value\" --output results/second --threads 2\n\n"
         "Ctrl-C ends the step, writes a snapshot and says how to go on; a second Ctrl-C, or the first one where no "
         "step\n"
         "has begun, ends the program at once.\n"
         "Exit status: 0 done, 1 the run failed, 2 a mistake on the command line or in the parameters,\n"
         "             130 stopped by Ctrl-C.";
}

std::string options_known(const CLI::App &app, const std::string &wrong)
{
  std::vector<std::string> names;
  for (const CLI::Option *option : app.get_options())
    for (const std::string &name : option->get_lnames())
      names.push_back("--" + name);
  return did_you_mean(wrong.substr(0, wrong.find('=')), names);
}

void check_threads(const CommandLine &command_line)
{
  if (!command_line.threads)
    return;
  const int n_cores = omp_get_num_procs();
  if (*command_line.threads < 1 || *command_line.threads > 4 * n_cores)
    throw ConfigError("--threads " + std::to_string(*command_line.threads) + " is out of range; allowed: 1 to " +
                      std::to_string(4 * n_cores) + " (four for each of this machine's " + std::to_string(n_cores) +
                      " cores)");
}

void check_file(const std::filesystem::path &file, const std::string &driver)
{
  namespace fs = std::filesystem;
  std::error_code ignored;
  if (!fs::exists(file, ignored))
    throw ConfigError("parameter file '" + file.string() + "' does not exist; check the path, or write one with '" +
                      driver + " --print-parameters'");
  if (fs::is_directory(file, ignored))
    throw ConfigError("parameter file '" + file.string() + "' is a folder; name a file in it");
}

void check_files(const CommandLine &command_line, const std::string &driver)
{
  namespace fs = std::filesystem;
  const std::vector<fs::path> &files = command_line.parameter_files;
  if (files.empty() && !command_line.print_parameters && command_line.help_topic.empty())
    throw ConfigError("no parameter file given; use '" + driver + " file.prm', and '" + driver +
                      " --print-parameters' to write one");
  for (const fs::path &file : files)
    check_file(file, driver);
  for (std::size_t i = 0; i < files.size(); ++i) // a slip of the hand: it would change nothing, or undo a file between
    for (std::size_t j = 0; j < i; ++j)
      if (fs::equivalent(files[i], files[j]))
        throw ConfigError("parameter file '" + files[i].string() + "' is given twice; remove one of the two");
}

void check(CommandLine &command_line, const std::string &driver)
{
  check_threads(command_line);
  if (command_line.force && command_line.restart)
    throw ConfigError("--force and --restart contradict each other; --restart goes on with the run in the folder, "
                      "--force begins a new one");
  if (command_line.output.string().starts_with("-"))
    throw ConfigError("--output " + command_line.output.string() +
                      " names no folder: --output needs one behind it (a name that begins with '-' is written "
                      "./-name)");
  for (const std::string &setting : command_line.settings)
    if (setting.find('=') == std::string::npos)
      throw ConfigError("--set \"" + setting + "\" has no '='; write --set \"Section/Name=value\"");
  check_files(command_line, driver);
  if (command_line.output.empty())
    command_line.output = std::filesystem::path("results") / (command_line.parameter_files.empty()
                                                                  ? std::filesystem::path(driver)
                                                                  : command_line.parameter_files.front().stem());
}

} // namespace

std::optional<CommandLine> parse_command_line(const int argc, const char *const *const argv,
                                              const DriverDescription &description)
{
  CommandLine command_line;
  CLI::App app(description.summary, description.name);
  app.footer("\n" + footer(description.name));
  app.set_help_flag();
  std::string topic;
  const CLI::Option *help =
      app.add_option("--help,-h", topic, "Explain the job, or a parameter or a section of them, then stop")
          ->type_name("[Section/Name]")
          ->expected(0, 1);
  app.get_formatter()->column_width(34);
  app.allow_extras();
  add_options(app, command_line);
  try
  {
    app.parse(argc, argv);
  }
  catch (const CLI::ParseError &error)
  {
    throw ConfigError(std::string(error.what()) + "; see '" + description.name + " --help'");
  }
  if (help->count() > 0)
    take_topic(topic, command_line);
  if (help->count() > 0 && command_line.help_topic.empty())
  {
    std::cout << app.help();
    return std::nullopt;
  }
  const std::vector<std::string> unknown = app.remaining();
  if (!unknown.empty())
  {
    const std::string known = unknown[0].starts_with("-") ? options_known(app, unknown[0]) : "";
    throw ConfigError((unknown[0].starts_with("-") ? "unknown option '" : "unexpected argument '") + unknown[0] + "'" +
                      (known.empty() ? "; see '" + description.name + " --help'" : known));
  }
  check(command_line, description.name);
  return command_line;
}

} // namespace bergamo::driver
