#pragma once

#include "benchmarks/peers/contestant.h"
#include "benchmarks/step_timing.h"

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace bergamo::benchmark
{

/// What one program says of a case over time: (time [s], measure).
struct Answer
{
  std::string program;
  std::vector<std::pair<double, double>> curve;
};

/// How two answers differ, in the unit of the measure.
struct AnswerDifference
{
  double root_mean_square = 0., largest = 0., at_end = 0.; ///< the last of `other` less the last of `answer`
};

/// @param answer,other of the same moments, at least one
AnswerDifference difference(const Answer &answer, const Answer &other);

/// Seconds that a program needs for the same steps, one entry a turn.
struct Timing
{
  std::string program;
  double distance = 0.; ///< of its neighbours, see Contestant
  std::vector<double> seconds;
};

/// Times of all programs for the same steps from the same state on.
struct TimeComparison
{
  std::vector<Timing> timings; ///< Bergamo's, and the others'
  std::size_t n_beads = 0;
  int n_steps = 0; ///< a turn

  double bead_steps() const { return static_cast<double>(n_beads) * n_steps; } ///< a turn
};

using Contestants = std::vector<std::unique_ptr<Contestant>>; ///< Bergamo first
using Log = std::function<void(const std::string &)>;         ///< is given a line at each stage

/// @return Bergamo's answer, Bergamo's for a start moved by nanometres, and the others'
std::vector<Answer> compare_answers(const BulkCase &bulk, const Contestants &contestants, const Log &log);

/// What is asked of the programs.
struct TimingOptions
{
  int n_turns = 5;
  int n_bead_steps = 1'000'000; ///< a turn
};

/// Turn by turn, from where Bergamo has come when beads move as they will; each program with the fastest of the
/// neighbour distances that it tries.
TimeComparison compare_times(const BulkCase &bulk, const Contestants &contestants, const TimingOptions &options,
                             const Log &log);

} // namespace bergamo::benchmark
