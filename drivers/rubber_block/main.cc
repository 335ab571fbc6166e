#include "drivers/common/driver_main.h"
#include "drivers/rubber_block/block_run.h"

int main(int argc, char **argv)
{
  using namespace bergamo::driver;
  return run_driver(
      argc, argv, {"rubber_block", "Presses a rubber block of elements on sand of superquadrics and pulls it over it."},
      [](const CommandLine &command_line)
      { return run_job<RubberBlockParameters, BlockRun>("A rubber block on sand", command_line); });
}
