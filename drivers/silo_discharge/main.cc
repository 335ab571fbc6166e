#include "drivers/common/driver_main.h"
#include "drivers/silo_discharge/silo_run.h"

using namespace bergamo::driver;

int main(int argc, char **argv)
{
  return run_driver(argc, argv,
                    {"silo_discharge",
                     "Fills a silo with a flat floor, opens its slot and lets it run out: mass flow, velocities, "
                     "Beverloo's law over several slots."},
                    [](const CommandLine &command_line)
                    { return run_job<SiloParameters, SiloRun>("Discharge of a silo", command_line); });
}
