#include "drivers/common/driver_main.h"
#include "drivers/membrane_triaxial/triaxial_run.h"

int main(int argc, char **argv)
{
  using namespace bergamo::driver;
  return run_driver(argc, argv,
                    {"membrane_triaxial", "Compresses grains in a rubber membrane between two plates, under a pressure "
                                          "from all around: the triaxial test as the laboratory has it."},
                    [](const CommandLine &command_line) {
                      return run_job<MembraneTriaxialParameters, MembraneTriaxialRun>("A triaxial test in a membrane",
                                                                                      command_line);
                    });
}
