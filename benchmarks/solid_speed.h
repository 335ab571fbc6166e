#pragma once

#include "benchmarks/core_peak.h"
#include "benchmarks/solid_case.h"
#include "benchmarks/solid_cost.h"
#include "benchmarks/step_timing.h"

#include <nlohmann/json.hpp>

#include <iosfwd>
#include <string>
#include <utility>
#include <vector>

namespace bergamo::benchmark
{

/// What the steps of a case cost on one thread, beside what they need.
struct SolidSpeed
{
  std::string name;
  int nodes_per_element = 0;
  double n_elements = 0., flowing_share = 0.;
  Spread step;                                       ///< [ns] an element
  std::vector<std::pair<std::string, Spread>> parts; ///< of the step [ns]
  Operations operations;                             ///< of an element
  ElementMemory memory;

  double operation_rate() const { return 1e9 * operations.whole() / step.median; } ///< [1/s]
  double moving_rate() const { return 1e9 * memory.moved / step.median; }          ///< [byte/s]
};

/// Steps of the body in turn with the pieces by themselves, see SolidPieces. What is a difference of two times is taken
/// as 0 where other work makes it negative. Throws if the motion diverges.
SolidSpeed measure_speed(const SolidCase &what, int n_along, int n_repeats, int n_steps);

/// Name and nodes of an element, as wide for every case.
std::string name_of(const SolidCase &what);

void print_rates(std::ostream &out, const std::vector<SolidSpeed> &speeds, const CorePeak &peak);
void print_parts(std::ostream &out, const std::vector<SolidSpeed> &speeds);
void print_needs(std::ostream &out, const std::vector<SolidSpeed> &speeds);

nlohmann::json json_of(const Spread &s);
nlohmann::json json_of(const SolidSpeed &speed);

} // namespace bergamo::benchmark
