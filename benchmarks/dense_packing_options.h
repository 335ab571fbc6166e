#pragma once

#include "benchmarks/settled_packing.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace bergamo::benchmark
{

struct DensePackingOptions
{
  std::vector<int> n_grains{4000};
  std::vector<GrainKind> kinds{GrainKind::superquadrics, GrainKind::spheres};
  int n_steps = 1000;
  int n_repeats = 3;
  int n_threads = 1;
  std::filesystem::path cache; ///< folder
  std::filesystem::path json;  ///< empty: none
  std::string liggghts = "liggghts";
  bool with_liggghts = true;
};

/// Reads and checks the command line; nothing after --help. @throws ConfigError
std::optional<DensePackingOptions> parse_dense_packing_options(int argc, const char *const *argv);

} // namespace bergamo::benchmark
