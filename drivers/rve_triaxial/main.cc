#include "drivers/common/driver_main.h"
#include "drivers/common/parameter_file.h"
#include "drivers/common/plots.h"
#include "drivers/common/run_folder.h"
#include "drivers/rve_triaxial/ensemble.h"
#include "drivers/rve_triaxial/parameters.h"

#include <iostream>

namespace
{

using namespace bergamo::driver;

int job(const CommandLine &command_line)
{
  RveParameters parameters;
  ParameterFile file("Triaxial tests on periodic cells of grains");
  parameters.declare(file);
  if (!read_parameters(file, command_line))
    return done;
  parameters.take_stages();
  parameters.validate();

  RunFolder folder(command_line);
  Ensemble ensemble(parameters, file.resolved_text(), folder, command_line.restart);
  if (!ensemble.run(command_line.quiet))
  {
    std::cout << "stopped; go on with --restart --output " << folder.path().string() << '\n';
    return stopped_by_user;
  }
  const Summary summary = ensemble.summary();
  summary.write(folder.summary());
  if (!command_line.quiet)
    std::cout << summary.table();
  if (command_line.plots)
  {
    const PlotResult plots = make_plots({{"rve_triaxial.py", {folder.path().string()}}});
    for (const std::string &warning : plots.warnings)
      std::cerr << "warning: " << warning << '\n';
    for (const auto &picture : plots.pictures)
      std::cout << "picture: " << picture.string() << '\n';
  }
  return done;
}

} // namespace

int main(int argc, char **argv)
{
  return run_driver(argc, argv,
                    {"rve_triaxial",
                     "Triaxial and other tests on periodic cells of grains: packs, compresses and loads an ensemble of "
                     "samples, several at once. fit_mohr_coulomb reads the result."},
                    job);
}
