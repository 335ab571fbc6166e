// Bulk processes that others publish, in Bergamo, LIGGGHTS and YADE on the same spheres and triangles: a silo, a drum
// and a ball shot into a bed; first whether all say the same, then what a step costs. `peers --help`.

#include "benchmarks/peers/bergamo_contestant.h"
#include "benchmarks/peers/liggghts_contestant.h"
#include "benchmarks/peers/peers_options.h"
#include "benchmarks/peers/peers_report.h"
#include "benchmarks/peers/yade_contestant.h"
#include "benchmarks/program.h"

#include <omp.h>

namespace
{

using namespace bergamo;
using namespace bergamo::benchmark;

template <class Peer>
void add_peer(Contestants &contestants, const std::optional<std::string> &program)
{
  if (!program)
    return;
  if (const auto path = find_program(*program))
    contestants.push_back(std::make_unique<Peer>(*path));
  else
    log_line("'" + *program + "' was not found: going on without it. On Debian: apt install liggghts yade");
}

BulkCase make_case(const std::string &name, CaseOptions options, const bool is_soft)
{
  log_line(name + ": beads come to rest");
  options.is_soft = is_soft;
  return name == "silo" ? silo_case(options) : name == "drum" ? drum_case(options) : penetration_case(options);
}

template <class Figures>
nlohmann::json report(const PeersOptions &options, const BulkCase &bulk, const Figures &figures)
{
  print(bulk, figures);
  write_csv(options.output, bulk, figures);
  return to_json(bulk, figures);
}

nlohmann::json measure(const PeersOptions &options)
{
  omp_set_num_threads(1);
  Contestants contestants;
  contestants.push_back(std::make_unique<BergamoContestant>());
  add_peer<LiggghtsContestant>(contestants, options.liggghts);
  add_peer<YadeContestant>(contestants, options.yade);
  nlohmann::json figures = nlohmann::json::array();
  for (const std::string &name : options.cases)
  {
    if (options.answers)
    {
      const BulkCase bulk = make_case(name, options.bulk, !options.bulk.full);
      figures.push_back(report(options, bulk, compare_answers(bulk, contestants, log_line)));
    }
    if (options.times)
    {
      const BulkCase bulk = make_case(name, options.bulk, false);
      figures.push_back(report(options, bulk, compare_times(bulk, contestants, options.timing, log_line)));
    }
  }
  return figures;
}

} // namespace

int main(const int argc, char **const argv)
{
  return run_program("peers",
                     [&]
                     {
                       if (const auto options = parse_peers_options(argc, argv))
                         write_figures(options->json, [&] { return measure(*options); });
                     });
}
