#include "drivers/common/packing_target.h"

#include "dem/core/error.h"

namespace bergamo::driver
{

void require_target(const dem::PackedGrains &packed, const double solid_fraction, const std::string &setting)
{
  if (!packed.report.has_reached_target)
    throw RunError("the geometric packing got stuck at a solid fraction of " +
                   std::to_string(packed.report.solid_fraction) + " of " + std::to_string(solid_fraction) +
                   ": choose a smaller " + setting);
}

} // namespace bergamo::driver
