#pragma once

#include "coupling/adapter/two_scale_model.h"
#include "drivers/common/progress.h"

namespace bergamo::driver
{

/// Brings a continuum that is joined to grains to rest under what the grains of the overlap put on it: a packing's
/// forces differ from place to place, and the continuum's own stresses do not yet. Ground too weak for all of them
/// starts in balance with a part, with a warning. Nothing without an overlap. Call once, before the first step. Needs
/// MPI, see run_with_mpi().
void start_at_rest(coupling::TwoScaleModel &model, Progress &progress);

} // namespace bergamo::driver
