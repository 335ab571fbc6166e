#include "drivers/common/driver_main.h"
#include "drivers/common/parameter_file.h"
#include "drivers/common/report_run.h"
#include "drivers/strip_footing/footing_run.h"

namespace
{

using namespace bergamo::driver;

int job(const CommandLine &command_line)
{
  FootingParameters parameters;
  ParameterFile file("Strip footing on elastoplastic ground");
  parameters.declare(file);
  if (!read_parameters(file, command_line))
    return done;
  parameters.validate();

  RunFolder folder(command_line);
  FootingRun run(parameters, command_line, file.resolved_text(), folder);
  if (!run.run())
    return report_stop(folder);
  const std::string path = folder.path().string();
  report_run(run.summary(), folder, command_line, {{"strip_footing.py", {path}}, {"energy.py", {path}}});
  return done;
}

} // namespace

int main(int argc, char **argv)
{
  return run_driver(argc, argv,
                    {"strip_footing",
                     "Presses a strip footing into Mohr-Coulomb ground in plane strain, from the ground at rest to the "
                     "limit load, and compares it with the closed form."},
                    job);
}
