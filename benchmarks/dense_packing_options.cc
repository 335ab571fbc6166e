#include "benchmarks/dense_packing_options.h"

#include "benchmarks/program.h"
#include "dem/core/error.h"

#include <omp.h>

#include <algorithm>

namespace bergamo::benchmark
{
namespace
{

void require_range(const std::string &option, const int value, const int least, const int most,
                   const std::string &reason)
{
  if (value < least || value > most)
    throw ConfigError(option + ' ' + std::to_string(value) + " is out of range; allowed: " + std::to_string(least) +
                      " to " + std::to_string(most) + " (" + reason + ')');
}

std::vector<GrainKind> kinds_of(const std::vector<std::string> &names)
{
  std::vector<GrainKind> kinds;
  for (const std::string &text : names)
    if (text == name(GrainKind::superquadrics))
      kinds.push_back(GrainKind::superquadrics);
    else if (text == name(GrainKind::spheres))
      kinds.push_back(GrainKind::spheres);
    else
      throw ConfigError("--shapes '" + text + "' is unknown; give superquadrics, spheres or both with a comma");
  return kinds;
}

template <class T>
void require_distinct(const std::string &option, const std::vector<T> &values)
{
  for (std::size_t i = 1; i < values.size(); ++i)
    if (std::find(values.begin(), values.begin() + i, values[i]) != values.begin() + i)
      throw ConfigError(option + " names the same value twice; give each once");
}

void check(const DensePackingOptions &options)
{
  for (const int n : options.n_grains)
    require_range("--grains", n, 1000, 1000000, "fewer mostly touch a wall, more take hours to settle");
  require_distinct("--grains", options.n_grains);
  require_distinct("--shapes", options.kinds);
  require_range("--steps", options.n_steps, 1, 1000000, "1000 are usual");
  require_range("--repeats", options.n_repeats, 1, 1000, "the figures are medians over them");
  const int n_cores = omp_get_num_procs();
  require_range("--threads", options.n_threads, 1, n_cores,
                "this machine's cores; more threads would only disturb each other");
  make_cache(options.cache);
}

constexpr const char *footer = R"(
The sand is Leighton Buzzard sand (half-axes 0.25 to 0.75 mm, exponents 0.6 to 1.2, 50 GPa, friction 0.24, damping
ratio 0.9) at 25 kPa between six rigid walls; the spheres have its grains' volumes. The time step is 0.3 of the stable
one. The ratios are quotients of medians of particle-steps per second and core: above 1 Bergamo is faster.

Settling takes about a minute for 4000 grains and a quarter of an hour for 50000, on one core; it is done once for each
folder of --cache.

Exit status: 0 done, 1 the run failed, 2 a mistake on the command line.

Examples:
  dense_packing --grains 4000,50000 --json dense_packing.json
  dense_packing --shapes superquadrics --no-liggghts --threads 2)";

} // namespace

std::optional<DensePackingOptions> parse_dense_packing_options(const int argc, const char *const *const argv)
{
  DensePackingOptions options;
  options.cache = BERGAMO_PACKING_CACHE;
  std::vector<std::string> shapes{"superquadrics", "spheres"};
  bool without_liggghts = false;

  CLI::App app(
      "Times the steps of a settled dense packing of sand and of spheres, beside LIGGGHTS on the same spheres.",
      "dense_packing");
  app.set_help_flag("--help,-h", "Explain the program and its options, then stop");
  app.get_formatter()->column_width(34);
  app.footer(footer);
  app.add_option("--grains", options.n_grains, "Numbers of grains, with commas (default: 4000)")
      ->type_name("N,...")
      ->delimiter(',');
  app.add_option("--shapes", shapes, "superquadrics, spheres or both with a comma (default: both)")
      ->type_name("NAME,...")
      ->delimiter(',');
  app.add_option("--steps", options.n_steps, "Measured steps (default: 1000)")->type_name("N");
  app.add_option("--repeats", options.n_repeats, "Measurements of each, all from the same state (default: 3)")
      ->type_name("N");
  app.add_option("--threads", options.n_threads, "Threads of Bergamo; LIGGGHTS always has one core (default: 1)")
      ->type_name("N");
  app.add_option("--cache", options.cache, "Folder of settled packings (default: " + options.cache.string() + ")")
      ->type_name("FOLDER");
  app.add_option("--json", options.json, "Write the figures to this file, too")->type_name("FILE");
  app.add_option("--liggghts", options.liggghts, "Name or path of LIGGGHTS (default: liggghts)")->type_name("PROGRAM");
  app.add_flag("--no-liggghts", without_liggghts, "Leave LIGGGHTS out");
  if (!parse_arguments(app, argc, argv))
    return std::nullopt;
  options.kinds = kinds_of(shapes);
  options.with_liggghts = !without_liggghts;
  check(options);
  return options;
}

} // namespace bergamo::benchmark
