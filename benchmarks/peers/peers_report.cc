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

/// A curve's value in the middle of its moments.
double middle(const Answer &answer)
{
  return answer.curve[answer.curve.size() / 2].second;
}

void print_head(const BulkCase &bulk)
{
  std::cout << '\n'
            << bulk.name << ": " << bulk.beads.size() << " spheres, " << bulk.vessel.topology.n_faces()
            << " triangles, step " << std::setprecision(3) << 1e6 * bulk.parameters.time_step << " us; ";
}

nlohmann::json head(const BulkCase &bulk)
{
  return {{"case", bulk.name},
          {"spheres", bulk.beads.size()},
          {"triangles", bulk.vessel.topology.n_faces()},
          {"time_step", bulk.parameters.time_step}};
}

} // namespace

void print(const BulkCase &bulk, const std::vector<Answer> &answers)
{
  print_head(bulk);
  std::cout << bulk.measure.name << (bulk.measure.unit.empty() ? "" : " [" + bulk.measure.unit + ']') << " after "
            << static_cast<double>(bulk.n_steps()) * bulk.parameters.time_step << " s\n"
            << std::left << std::setw(name_width) << "" << std::right << std::setw(11) << "half-way" << std::setw(11)
            << "end" << std::setw(30) << "beside Bergamo: rms, largest\n";
  for (const Answer &a : answers)
  {
    const AnswerDifference d = difference(answers.front(), a);
    std::cout << std::left << std::setw(name_width) << a.program << std::right << std::setprecision(5) << std::setw(11)
              << middle(a) << std::setw(11) << a.curve.back().second << std::setprecision(3) << std::setw(18)
              << d.root_mean_square << std::setw(11) << d.largest << '\n';
  }
  std::cout << std::flush;
}

void print(const BulkCase &bulk, const TimeComparison &times)
{
  print_head(bulk);
  std::cout
      << times.n_steps << " steps of " << times.n_beads
      << " beads:\nmillion bead-steps/s, least, median, most; neighbour distance over radius; Bergamo is faster by\n";
  const double mine = spread(times.timings.front().seconds).median;
  for (const Timing &t : times.timings)
  {
    const Spread seconds = spread(t.seconds);
    std::cout << std::left << std::setw(name_width) << t.program << std::right << std::setprecision(3);
    for (const double s : {seconds.most, seconds.median, seconds.least})
      std::cout << std::setw(9) << 1e-6 * times.bead_steps() / s;
    std::cout << std::setw(9) << t.distance << std::setw(9) << seconds.median / mine << '\n';
  }
  std::cout << std::flush;
}

void write_csv(const std::filesystem::path &folder, const BulkCase &bulk, const std::vector<Answer> &answers)
{
  std::ostringstream text;
  text << "time_s";
  for (const Answer &a : answers)
    text << ",\"" << a.program << '"';
  for (std::size_t k = 0; k < answers.front().curve.size(); ++k)
  {
    text << '\n' << answers.front().curve[k].first;
    for (const Answer &a : answers)
      text << ',' << a.curve.at(k).second;
  }
  write_whole_file(folder / (bulk.name + ".csv"), text.str() + '\n');
}

void write_csv(const std::filesystem::path &folder, const BulkCase &bulk, const TimeComparison &times)
{
  std::ostringstream text;
  text << "program,turn,seconds,bead_steps\n";
  for (const Timing &t : times.timings)
    for (std::size_t turn = 0; turn < t.seconds.size(); ++turn)
      text << t.program << ',' << turn << ',' << t.seconds[turn] << ',' << times.bead_steps() << '\n';
  write_whole_file(folder / (bulk.name + "_times.csv"), text.str());
}

nlohmann::json to_json(const BulkCase &bulk, const std::vector<Answer> &answers)
{
  nlohmann::json json = head(bulk);
  json["measure"] = bulk.measure.name;
  for (const Answer &a : answers)
  {
    const AnswerDifference d = difference(answers.front(), a);
    json["answers"].push_back(
        {{"program", a.program},
         {"at_end", a.curve.back().second},
         {"difference", {{"rms", d.root_mean_square}, {"largest", d.largest}, {"at_end", d.at_end}}}});
  }
  return json;
}

nlohmann::json to_json(const BulkCase &bulk, const TimeComparison &times)
{
  nlohmann::json json = head(bulk);
  for (const Timing &t : times.timings)
  {
    const Spread s = spread(t.seconds);
    json["times"].push_back(
        {{"program", t.program},
         {"neighbour_distance", t.distance},
         {"seconds_a_step",
          {{"least", s.least / times.n_steps}, {"median", s.median / times.n_steps}, {"most", s.most / times.n_steps}}},
         {"bead_steps_per_second", times.bead_steps() / s.median}});
  }
  return json;
}

} // namespace bergamo::benchmark
