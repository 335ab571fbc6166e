#pragma once

#include "benchmarks/peers/bulk_case.h"

namespace bergamo::benchmark
{

/// What the command line says about the cases.
struct CaseOptions
{
  bool full = false;        ///< many beads and published durations, instead of small ones
  bool is_soft = false;     ///< beads softer than published, so that steps may be longer
  int n_penetrated = 25000; ///< beads under the ball, where full
  bool has_large_orifice = false;
  std::int32_t silo_material = material_1;
};

/// Beads run out of a silo; judged by how many are left above the orifice.
BulkCase silo_case(const CaseOptions &options);

/// Two materials side by side in a drum that turns; judged by Lacey's index.
BulkCase drum_case(const CaseOptions &options);

/// A ball of steel shot into beads in a box; judged by how deep it is.
BulkCase penetration_case(const CaseOptions &options);

} // namespace bergamo::benchmark
