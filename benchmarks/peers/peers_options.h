#pragma once

#include "benchmarks/peers/cases.h"
#include "benchmarks/peers/comparison.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace bergamo::benchmark
{

struct PeersOptions
{
  std::vector<std::string> cases{"silo", "drum", "penetration"};
  CaseOptions bulk;
  bool answers = true, times = true;
  TimingOptions timing;
  std::optional<std::string> liggghts = "liggghts", yade = "yade"; ///< names or paths; nothing: left out
  std::filesystem::path output = "results/peers", json;
};

/// Nothing if only help was asked for; throws ConfigError for a mistake.
std::optional<PeersOptions> parse_peers_options(int argc, const char *const *argv);

} // namespace bergamo::benchmark
