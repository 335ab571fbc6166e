#include "benchmarks/peers/peers_options.h"

#include "benchmarks/program.h"
#include "dem/core/error.h"

namespace bergamo::benchmark
{
namespace
{

constexpr const char *footer = R"(
The cases are those of Dosta et al. (2024), Comput. Phys. Commun. 109066: materials, frictions and restitutions are
theirs, packings and vessels our own. They are spheres of 4 mm: 1500 out of a silo (--full: 20000), 1000 in a drum that
turns with 2 rad/s (15000), 2500 under a ball of steel (25000, 50000 or 100000). For the answers of small cases
beads are softer than published, by a factor of 400, under the ball of 100, hence time steps 20 and 10 times as long;
times are those of the published moduli and steps. All programs read the same places, velocities and triangles, and
step with the same time step and formulas; what cannot be the same stands in liggghts_contestant.h and
yade_contestant.h. Contacts start without a memory of what was before.

Debian has the other programs: apt install liggghts yade. One that is missing is left out, and said to be.

Keep the machine free. Times are those of steps alone, one thread each, in turns; ratios are quotients of medians.

Exit status: 0 done, 1 a run failed, 2 a mistake on the command line.

Examples:
  peers && /usr/bin/python3 benchmarks/peers/plot.py results/peers peers.png
  peers --cases penetration --full --beads 50000 --no-answers --no-yade)";

void check(const PeersOptions &options)
{
  for (const int n : {options.timing.n_turns, options.timing.n_bead_steps})
    require(n >= 1, "--turns or --bead-steps", n, "at least 1");
  std::error_code error;
  std::filesystem::create_directories(options.output, error);
  if (error)
    reject("--output '", options.output.string(), "' cannot be made: ", error.message(),
           "; name a folder that you may write to");
}

} // namespace

std::optional<PeersOptions> parse_peers_options(const int argc, const char *const *const argv)
{
  PeersOptions options;
  bool without_liggghts = false, without_yade = false;
  std::string material = "M1", orifice = "small";
  CLI::App app("Bulk processes beside LIGGGHTS and YADE: answers over one another, then seconds of a step.", "peers");
  app.set_help_flag("--help,-h", "Explain the program and its options, then stop");
  app.get_formatter()->column_width(34);
  app.footer(footer);
  app.add_option("--cases", options.cases, "silo, drum, penetration, with commas (default: all)")
      ->type_name("NAME,...")
      ->delimiter(',')
      ->check(CLI::IsMember({"silo", "drum", "penetration"}));
  app.add_flag("--full", options.bulk.full, "Published moduli, steps and durations, and many beads: hours");
  app.add_option("--beads", options.bulk.n_penetrated, "Under the ball, with --full (default: 25000)")
      ->type_name("N")
      ->check(CLI::IsMember({25000, 50000, 100000}));
  app.add_option("--material", material, "Of the beads in the silo, M1 or M2 (default: M1)")
      ->type_name("NAME")
      ->check(CLI::IsMember({"M1", "M2"}));
  app.add_option("--orifice", orifice, "Of the silo, small (30 mm) or large (40 mm) (default: small)")
      ->type_name("SIZE")
      ->check(CLI::IsMember({"small", "large"}));
  app.add_flag("!--no-answers", options.answers, "Times alone");
  app.add_flag("!--no-times", options.times, "Answers alone");
  app.add_option("--turns", options.timing.n_turns, "Of each program, for the times (default: 5)")->type_name("N");
  app.add_option("--bead-steps", options.timing.n_bead_steps, "Beads times steps of a turn (default: 1 million)")
      ->type_name("N");
  app.add_option("--output", options.output, "Folder for curves and times as csv (default: results/peers)")
      ->type_name("FOLDER");
  app.add_option("--json", options.json, "Write the figures to this file, too")->type_name("FILE");
  app.add_option("--liggghts", *options.liggghts, "Name or path of LIGGGHTS (default: liggghts)")->type_name("PROGRAM");
  app.add_option("--yade", *options.yade, "Name or path of YADE (default: yade)")->type_name("PROGRAM");
  app.add_flag("--no-liggghts", without_liggghts, "Leave LIGGGHTS out");
  app.add_flag("--no-yade", without_yade, "Leave YADE out");
  if (!parse_arguments(app, argc, argv))
    return std::nullopt;
  options.bulk.silo_material = material == "M1" ? material_1 : material_2;
  options.bulk.has_large_orifice = orifice == "large";
  if (without_liggghts)
    options.liggghts.reset();
  if (without_yade)
    options.yade.reset();
  check(options);
  return options;
}

} // namespace bergamo::benchmark
