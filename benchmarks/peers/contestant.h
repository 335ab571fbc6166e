#pragma once

#include "benchmarks/peers/bulk_case.h"

#include <string>
#include <vector>

namespace bergamo::benchmark
{

/// A program that runs cases on one core. Distances within which it keeps neighbours, beyond contact, are given over
/// the mean radius of the beads.
class Contestant
{
public:
  static constexpr int warm_up_steps = 300; ///< not measured; contacts and their history exist afterwards

  virtual ~Contestant() = default;

  virtual std::string name() const = 0;
  virtual std::vector<double> distances() const = 0; ///< worth a trial

  /// The whole run. Throws RunError if the program fails.
  virtual Track run(const BulkCase &bulk, double distance) = 0;

  /// Seconds of some steps from the start of the case on, after those of the warm-up. Throws RunError likewise.
  virtual double time(const BulkCase &bulk, int n_steps, double distance) = 0;
};

} // namespace bergamo::benchmark
