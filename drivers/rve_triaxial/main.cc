#include "drivers/common/driver_main.h"
#include "drivers/common/parameter_file.h"
#include "drivers/common/report_run.h"
#include "drivers/rve_triaxial/ensemble.h"
#include "drivers/rve_triaxial/parameters.h"

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
    return report_stop(folder);
  report_run(ensemble.summary(), folder, command_line, {{"rve_triaxial/plot.py", {folder.path().string()}}});
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
