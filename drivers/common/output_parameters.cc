#include "drivers/common/output_parameters.h"

namespace bergamo::driver
{

void OutputParameters::declare(ParameterFile &file, const std::string &shown)
{
  file.add("Output", "samples", n_samples, "rows of history.csv", Range::between(1, 1000000));
  file.add("Output", "pictures", n_pictures, "times at which " + shown + " written for ParaView",
           Range::between(1, 10000));
  file.add("Output", "snapshot interval", snapshot_interval, "wall clock time between snapshots [s]",
           Range::positive());
}

} // namespace bergamo::driver
