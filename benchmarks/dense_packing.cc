// Speed of the steps of a settled dense packing, where the work of a quasi-static test lies: particle-steps per second
// and core for sand and for spheres, with LIGGGHTS on the same spheres as the yardstick. `dense_packing --help`.

#include "benchmarks/child_process.h"
#include "benchmarks/dense_packing_options.h"
#include "benchmarks/dense_packing_report.h"
#include "benchmarks/packing_cache.h"
#include "benchmarks/program.h"

#include <omp.h>

#include <memory>

namespace
{

using namespace bergamo;
using namespace bergamo::benchmark;

std::optional<std::filesystem::path> find_liggghts(const DensePackingOptions &options)
{
  if (!options.with_liggghts)
    return std::nullopt;
  const auto program = find_program(options.liggghts);
  if (!program)
    log_line("LIGGGHTS '" + options.liggghts +
             "' was not found: going on without it. On Debian: apt install liggghts, or give its path by --liggghts.");
  return program;
}

/// The runs of all programs take turns, so that whatever else the machine does meets them alike.
SizeResult measure(const DensePackingOptions &options, const int n_grains,
                   const std::optional<std::filesystem::path> &liggghts_program)
{
  SizeResult result{n_grains, {}, {}};
  std::vector<std::unique_ptr<dem::Simulation>> packings;
  std::unique_ptr<Liggghts> liggghts;
  for (const GrainKind kind : options.kinds)
  {
    packings.push_back(cached_packing(options.cache, {.kind = kind, .n_grains = n_grains}, log_line));
    const dem::Simulation &packing = *packings.back();
    result.engine.push_back({kind,
                             packing_figures(packing),
                             packing.parameters().time_step,
                             packing.stable_time_step(),
                             options.n_threads,
                             {}});
    if (kind == GrainKind::spheres && liggghts_program)
    {
      liggghts = std::make_unique<Liggghts>(*liggghts_program, packing);
      result.liggghts = LiggghtsResult{liggghts->fastest_skin(), options.n_steps, {}};
    }
  }
  for (int repeat = 0; repeat < options.n_repeats; ++repeat)
  {
    for (std::size_t k = 0; k < packings.size(); ++k)
      result.engine[k].runs.push_back(time_steps(*packings[k], options.n_steps));
    if (liggghts)
      result.liggghts->runs.push_back(liggghts->run(options.n_steps, result.liggghts->skin));
  }
  return result;
}

nlohmann::json measure(const DensePackingOptions &options)
{
  omp_set_num_threads(options.n_threads);
  const auto liggghts_program = find_liggghts(options);
  std::vector<SizeResult> results;
  for (const int n_grains : options.n_grains)
  {
    results.push_back(measure(options, n_grains, liggghts_program));
    print(results.back());
  }
  return to_json(results);
}

} // namespace

int main(const int argc, char **const argv)
{
  return run_program("dense_packing",
                     [&]
                     {
                       if (const auto options = parse_dense_packing_options(argc, argv))
                         write_figures(options->json, [&] { return measure(*options); });
                     });
}
