#include "benchmarks/peers/comparison.h"

#include "benchmarks/peers/bergamo_contestant.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bergamo::benchmark
{
namespace
{

constexpr double usual_distance = 0.1; // of neighbours, where time does not matter
constexpr std::uint64_t perturbation_seed = 7;

Answer answer(Contestant &contestant, const std::string &name, const BulkCase &bulk)
{
  Answer result{name, {}};
  for (const Frame &frame : contestant.run(bulk, usual_distance))
    result.curve.emplace_back(frame.time, bulk.measure.of(frame));
  return result;
}

double fastest_distance(Contestant &contestant, const BulkCase &bulk, const int n_steps)
{
  double best = 0., least = std::numeric_limits<double>::infinity();
  for (const double distance : contestant.distances())
    if (const double seconds = contestant.time(bulk, n_steps, distance); seconds < least)
    {
      least = seconds;
      best = distance;
    }
  return best;
}

} // namespace

AnswerDifference difference(const Answer &answer, const Answer &other)
{
  AnswerDifference result;
  const std::size_t n = std::min(answer.curve.size(), other.curve.size());
  for (std::size_t k = 0; k < n; ++k)
  {
    const double d = other.curve[k].second - answer.curve[k].second;
    result.root_mean_square += d * d / static_cast<double>(n);
    result.largest = std::max(result.largest, std::abs(d));
    result.at_end = d;
  }
  result.root_mean_square = std::sqrt(result.root_mean_square);
  return result;
}

std::vector<Answer> compare_answers(const BulkCase &bulk, const Contestants &contestants, const Log &log)
{
  std::vector<Answer> answers;
  for (const auto &contestant : contestants)
  {
    log(bulk.name + ": " + contestant->name() + " runs it");
    answers.push_back(answer(*contestant, contestant->name(), bulk));
    if (contestant == contestants.front())
      answers.push_back(
          answer(*contestant, contestant->name() + ", start moved by 1 nm", perturbed(bulk, perturbation_seed)));
  }
  return answers;
}

TimeComparison compare_times(const BulkCase &bulk, const Contestants &contestants, const TimingOptions &options,
                             const Log &log)
{
  log(bulk.name + ": all take turns");
  const BulkCase timed = advanced(bulk, bulk.developed);
  TimeComparison result;
  result.n_beads = timed.beads.size();
  result.n_steps = std::max(1, options.n_bead_steps / static_cast<int>(timed.beads.size()));
  for (const auto &contestant : contestants)
    result.timings.push_back(
        {contestant->name(), fastest_distance(*contestant, timed, std::max(1, result.n_steps / 2)), {}});
  for (int turn = 0; turn < options.n_turns; ++turn)
    for (std::size_t k = 0; k < contestants.size(); ++k)
      result.timings[k].seconds.push_back(contestants[k]->time(timed, result.n_steps, result.timings[k].distance));
  return result;
}

} // namespace bergamo::benchmark
