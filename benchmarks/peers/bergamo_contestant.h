#pragma once

#include "benchmarks/peers/contestant.h"

namespace bergamo::benchmark
{

class BergamoContestant : public Contestant
{
public:
  std::string name() const override { return "Bergamo"; }
  std::vector<double> distances() const override { return {0.05, 0.1, 0.2, 0.4}; }
  Track run(const BulkCase &bulk, double distance) override;
  double time(const BulkCase &bulk, int n_steps, double distance) override;
};

/// The case as it is after some time, without what contacts remember: a start that all programs can read.
BulkCase advanced(const BulkCase &bulk, double seconds);

} // namespace bergamo::benchmark
