#include "benchmarks/program.h"

#include "dem/core/error.h"
#include "dem/core/whole_file.h"

#include <iostream>
#include <memory>

namespace bergamo::benchmark
{

void log_line(const std::string &line)
{
  std::cerr << line << std::endl;
}

bool parse_arguments(CLI::App &app, const int argc, const char *const *const argv)
{
  try
  {
    app.parse(argc, argv);
    return true;
  }
  catch (const CLI::CallForHelp &)
  {
    std::cout << app.help();
    return false;
  }
  catch (const CLI::ParseError &error)
  {
    throw ConfigError(std::string(error.what()) + "; see '" + app.get_name() + " --help'");
  }
}

void make_cache(const std::filesystem::path &folder)
{
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error)
    throw ConfigError("--cache '" + folder.string() + "' cannot be made: " + error.message() +
                      "; name a folder that you may write to");
}

void write_figures(const std::filesystem::path &json, const std::function<nlohmann::json()> &measure)
{
  std::unique_ptr<WholeFile> file;
  if (!json.empty())
    file = std::make_unique<WholeFile>(json);
  const nlohmann::json figures = measure();
  if (!file)
    return;
  file->write(figures.dump(2) + '\n');
  file->commit();
}

int run_program(const std::string &name, const std::function<void()> &run)
{
  try
  {
    run();
    return 0;
  }
  catch (const ConfigError &error)
  {
    log_line(name + ": " + error.what());
    return 2;
  }
  catch (const std::exception &error)
  {
    log_line(name + ": " + error.what());
    return 1;
  }
}

} // namespace bergamo::benchmark
