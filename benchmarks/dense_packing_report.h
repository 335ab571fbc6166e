#pragma once

#include "benchmarks/liggghts.h"
#include "benchmarks/settled_packing.h"
#include "benchmarks/step_timing.h"

#include <nlohmann/json.hpp>

#include <optional>
#include <vector>

namespace bergamo::benchmark
{

/// The engine's measurements of one packing.
struct EngineResult
{
  GrainKind kind;
  PackingFigures packing;
  double time_step = 0., stable_time_step = 0.; ///< [s]
  int n_threads = 1;
  std::vector<StepTiming> runs;
};

/// LIGGGHTS' measurements of the spheres.
struct LiggghtsResult
{
  double skin = 0.; ///< over the mean radius
  int n_steps = 0;
  std::vector<LiggghtsRun> runs;
};

/// All measurements of one number of grains.
struct SizeResult
{
  int n_grains = 0;
  std::vector<EngineResult> engine;
  std::optional<LiggghtsResult> liggghts;
};

/// Prints the figures of one number of grains to standard output.
void print(const SizeResult &result);

/// The figures of all numbers of grains; the ratios at the top are those of 4000 grains, null where not measured.
nlohmann::ordered_json to_json(const std::vector<SizeResult> &results);

} // namespace bergamo::benchmark
