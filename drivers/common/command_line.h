#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace bergamo::driver
{

/// What the user asked for on the command line of a driver.
struct CommandLine
{
  std::vector<std::filesystem::path> parameter_files; ///< in the order given, later ones win; none only with
                                                      ///< print_parameters and help_topic
  std::vector<std::string> settings; ///< texts "Section/Name=value" in the order given; they win over the files
  std::optional<int> threads;        ///< number of OpenMP threads; nothing: one a core
  std::filesystem::path output;      ///< the run's folder; results/<name of the first parameter file> by default
  bool force = false;                ///< take over a folder that holds an earlier run
  bool restart = false;              ///< go on from the snapshot in the folder
  bool quiet = false;                ///< no progress, no table
  bool plots = true;                 ///< draw the pictures at the end
  bool print_parameters = false;     ///< write a commented parameter file with the values in force, then stop
  bool dry_run = false;              ///< tell what the run would be, then stop; nothing is written
  std::string help_topic;            ///< "Section/Name": explain that, then stop; empty: nothing asked
  std::vector<std::string> warnings; ///< of what the parameters have that is unusual; kept in summary.json
};

/// The words of a driver's --help.
struct DriverDescription
{
  std::string name;    ///< the program's name
  std::string summary; ///< what the job computes, in a few lines
};

/// Reads the command line. Returns nothing when --help without a topic was asked for; its text is then on standard
/// output.
/// Throws ConfigError with the remedy for unknown or contradicting options, a number of threads below 1 or above four
/// for a core, an output folder that is an option's name, a missing parameter file, one given twice or a malformed
/// --set.
std::optional<CommandLine> parse_command_line(int argc, const char *const *argv, const DriverDescription &description);

} // namespace bergamo::driver
