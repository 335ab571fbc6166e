#include "drivers/common/driver_main.h"
#include "drivers/two_scale_triaxial/triaxial_run.h"

int main(int argc, char **argv)
{
  using namespace bergamo::driver;
  return run_driver(
      argc, argv,
      {"two_scale_triaxial",
       "Triaxial test on a cube of sand: grains in the upper half, continuum in the lower half, joined in "
       "an overlap (Arlequin method). Compresses the cube isotropically and then shears it."},
      [](const CommandLine &command_line)
      { return run_job<TriaxialParameters, TriaxialRun>("Two-scale triaxial test", command_line); });
}
