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

struct Comparison
{
  std::vector<Answer> answers; ///< Bergamo's, Bergamo's of a start moved by nanometres, and the others'
  std::vector<Timing> timings; ///< Bergamo's, and the others'
  std::size_t n_beads_timed = 0;
  int n_steps_timed = 0;
};

/// What is asked of the programs.
struct ComparisonOptions
{
  bool answers = true, times = true;
  int n_turns = 5;
  int n_bead_steps = 1'000'000; ///< of each turn
};

/// Answers, one program after the other; then times, in turns from the same state on, each program with the fastest of
/// the neighbour distances that it tries.
/// @param contestants Bergamo first; @param log is given a line at each stage
Comparison compare(const BulkCase &bulk, const std::vector<std::unique_ptr<Contestant>> &contestants,
                   const ComparisonOptions &options, const std::function<void(const std::string &)> &log);

} // namespace bergamo::benchmark
