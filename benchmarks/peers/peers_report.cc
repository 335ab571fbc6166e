#include "benchmarks/peers/peers_report.h"

#include "dem/core/whole_file.h"

#include <iomanip>
#include <iostream>
#include <sstream>

namespace bergamo::benchmark
{
namespace
{

constexpr int name_width = 34;

double bead_steps(const Comparison &comparison)
{
  return static_cast<double>(comparison.n_beads_timed) * comparison.n_steps_timed;
}

/// A curve's value in the middle of its moments.
double middle(const Answer &answer)
{
  return answer.curve[answer.curve.size() / 2].second;
}

void print_answers(const BulkCase &bulk, const Comparison &comparison)
{
  const std::string unit = bulk.measure.unit.empty() ? "" : " [" + bulk.measure.unit + ']';
  std::cout << bulk.measure.name << unit << " after " << static_cast<double>(bulk.n_steps()) * bulk.parameters.time_step
            << " s\n"
            << std::left << std::setw(name_width) << "" << std::right << std::setw(11) << "half-way" << std::setw(11)
            << "end" << std::setw(30) << "beside Bergamo: rms, largest\n";
  for (const Answer &a : comparison.answers)
  {
    const AnswerDifference d = difference(comparison.answers.front(), a);
    std::cout << std::left << std::setw(name_width) << a.program << std::right << std::setprecision(5) << std::setw(11)
              << middle(a) << std::setw(11) << a.curve.back().second << std::setprecision(3) << std::setw(18)
              << d.root_mean_square << std::setw(11) << d.largest << '\n';
  }
}

void print_times(const Comparison &comparison)
{
  const double mine = spread(comparison.timings.front().seconds).median;
  std::cout << comparison.n_steps_timed << " steps of " << comparison.n_beads_timed
            << " beads: million bead-steps/s, least, median, most; neighbour distance; Bergamo is faster by\n";
  for (const Timing &t : comparison.timings)
  {
    const Spread seconds = spread(t.seconds);
    std::cout << std::left << std::setw(name_width) << t.program << std::right << std::setprecision(3);
    for (const double s : {seconds.most, seconds.median, seconds.least})
      std::cout << std::setw(9) << 1e-6 * bead_steps(comparison) / s;
    std::cout << std::setw(9) << t.distance << std::setw(9) << seconds.median / mine << '\n';
  }
}

} // namespace

void print(const BulkCase &bulk, const Comparison &comparison)
{
  std::cout << '\n'
            << bulk.name << ": " << bulk.beads.size() << " spheres, " << bulk.vessel.topology.n_faces()
            << " triangles, step " << 1e6 * bulk.parameters.time_step << " us\n";
  if (!comparison.answers.empty())
    print_answers(bulk, comparison);
  if (!comparison.timings.empty())
    print_times(comparison);
  std::cout << std::flush;
}

void write_csv(const std::filesystem::path &folder, const BulkCase &bulk, const Comparison &comparison)
{
  if (!comparison.answers.empty())
  {
    std::ostringstream text;
    text << "time_s";
    for (const Answer &a : comparison.answers)
      text << ",\"" << a.program << '"';
    for (std::size_t k = 0; k < comparison.answers.front().curve.size(); ++k)
    {
      text << '\n' << comparison.answers.front().curve[k].first;
      for (const Answer &a : comparison.answers)
        text << ',' << a.curve[k].second;
    }
    write_whole_file(folder / (bulk.name + ".csv"), text.str() + '\n');
  }
  if (!comparison.timings.empty())
  {
    std::ostringstream text;
    text << "program,turn,seconds,bead_steps\n";
    for (const Timing &t : comparison.timings)
      for (std::size_t turn = 0; turn < t.seconds.size(); ++turn)
        text << t.program << ',' << turn << ',' << t.seconds[turn] << ',' << bead_steps(comparison) << '\n';
    write_whole_file(folder / (bulk.name + "_times.csv"), text.str());
  }
}

nlohmann::json to_json(const BulkCase &bulk, const Comparison &comparison)
{
  nlohmann::json answers = nlohmann::json::array(), times = nlohmann::json::array();
  for (const Answer &a : comparison.answers)
  {
    const AnswerDifference d = difference(comparison.answers.front(), a);
    answers.push_back({{"program", a.program},
                       {"at_end", a.curve.back().second},
                       {"difference", {{"rms", d.root_mean_square}, {"largest", d.largest}, {"at_end", d.at_end}}}});
  }
  for (const Timing &t : comparison.timings)
  {
    const Spread s = spread(t.seconds);
    times.push_back({{"program", t.program},
                     {"neighbour_distance", t.distance},
                     {"seconds_a_step",
                      {{"least", s.least / comparison.n_steps_timed},
                       {"median", s.median / comparison.n_steps_timed},
                       {"most", s.most / comparison.n_steps_timed}}},
                     {"bead_steps_per_second", bead_steps(comparison) / s.median}});
  }
  return {{"case", bulk.name},
          {"spheres", bulk.beads.size()},
          {"triangles", bulk.vessel.topology.n_faces()},
          {"time_step", bulk.parameters.time_step},
          {"measure", bulk.measure.name},
          {"answers", answers},
          {"times", times}};
}

} // namespace bergamo::benchmark
