#include "benchmarks/dense_packing_report.h"

#include <cstdio>
#include <functional>
#include <string>

namespace bergamo::benchmark
{
namespace
{

using nlohmann::ordered_json;

template <class Run>
Spread spread_of(const std::vector<Run> &runs, const std::function<double(const Run &)> &value)
{
  std::vector<double> values;
  for (const Run &run : runs)
    values.push_back(value(run));
  return spread(std::move(values));
}

/// Particle-steps per second and core.
Spread rate(const EngineResult &result, const int n_grains)
{
  return spread_of<StepTiming>(result.runs, [&](const StepTiming &run)
                               { return double(n_grains) * run.n_steps / (run.seconds * result.n_threads); });
}

Spread rate(const LiggghtsResult &result, const int n_grains)
{
  return spread_of<LiggghtsRun>(result.runs, [&](const LiggghtsRun &run)
                                { return double(n_grains) * result.n_steps / run.seconds; });
}

/// Core time per contact between grains and step [ns].
Spread contact_time(const EngineResult &result)
{
  return spread_of<StepTiming>(result.runs,
                               [&](const StepTiming &run) {
                                 return 1e9 * run.seconds * result.n_threads / (double(run.n_contacts) * run.n_steps);
                               });
}

Spread contact_time(const LiggghtsResult &result)
{
  return spread_of<LiggghtsRun>(result.runs, [&](const LiggghtsRun &run)
                                { return 1e9 * run.seconds / (run.n_contacts * result.n_steps); });
}

/// Shares of the step's time over all runs; what the engine does not name is the rest. `seconds` become shares.
std::vector<Phase> phase_shares(const std::vector<StepTiming> &runs)
{
  std::vector<Phase> shares = runs.front().phases;
  if (shares.empty())
    return shares;
  double total = 0., named = 0.;
  for (Phase &phase : shares)
    phase.seconds = 0.;
  for (const StepTiming &run : runs)
  {
    total += run.seconds;
    for (std::size_t k = 0; k < shares.size(); ++k)
      shares[k].seconds += run.phases[k].seconds;
  }
  for (Phase &phase : shares)
  {
    phase.seconds /= total;
    named += phase.seconds;
  }
  shares.push_back({"rest", 1. - named});
  return shares;
}

double searches_per_contact(const StepTiming &run)
{
  return double(run.n_searches) / (double(run.n_contacts) * run.n_steps);
}

/// Our rate over LIGGGHTS'.
std::optional<double> ratio(const SizeResult &result, const GrainKind kind)
{
  if (result.liggghts)
    for (const EngineResult &engine : result.engine)
      if (engine.kind == kind)
        return rate(engine, result.n_grains).median / rate(*result.liggghts, result.n_grains).median;
  return std::nullopt;
}

constexpr GrainKind all_kinds[] = {GrainKind::superquadrics, GrainKind::spheres};

std::string ratio_name(const GrainKind kind)
{
  return name(kind) + "_over_liggghts_spheres";
}

void print_spread(const char *what, const Spread &s)
{
  std::printf("  %-38s %12.4g %12.4g %12.4g\n", what, s.least, s.median, s.most);
}

void print(const EngineResult &result, const int n_grains)
{
  const PackingFigures &p = result.packing;
  const StepTiming &run = result.runs.front();
  std::printf("\n%d %s, Bergamo, %d thread%s\n", n_grains, name(result.kind).c_str(), result.n_threads,
              result.n_threads == 1 ? "" : "s");
  std::printf("  packing: solid fraction %.4f, coordination %.3f, unbalanced force %.1e, pressure %.2f kPa\n",
              p.solid_fraction, p.coordination_number, p.unbalanced_force, p.pressure / 1e3);
  std::printf("  time step %.3e s, %.2f of the stable one; %d steps\n", result.time_step,
              result.time_step / result.stable_time_step, run.n_steps);
  std::printf("  Verlet pairs %zu, contacts %zu, coordination %.3f, rebuilds %lld\n", run.n_pairs, run.n_contacts,
              2. * run.n_contacts / n_grains, static_cast<long long>(run.n_rebuilds));
  std::printf("  searches per contact and step %.4g\n", searches_per_contact(run));
  const auto a_grain = [&](const std::size_t bytes) { return double(bytes) / n_grains; };
  std::printf("  bytes a grain and step %.0f: contacts %.0f, candidates %.0f, grains %.0f; %.2f GB/s a core\n",
              a_grain(run.bytes.sum()), a_grain(run.bytes.contacts), a_grain(run.bytes.candidates),
              a_grain(run.bytes.grains), 1e-9 * a_grain(run.bytes.sum()) * rate(result, n_grains).median);
  std::printf("  %-38s %12s %12s %12s\n", "", "min", "median", "max");
  print_spread("particle-steps per second and core", rate(result, n_grains));
  print_spread("ns per contact and step", contact_time(result));
  const std::vector<Phase> shares = phase_shares(result.runs);
  if (!shares.empty())
    std::printf("  shares of the step:");
  for (const Phase &phase : shares)
    std::printf(" %s %.1f %%%s", phase.name.c_str(), 100. * phase.seconds, &phase == &shares.back() ? "\n" : ",");
}

void print(const LiggghtsResult &result, const int n_grains)
{
  const LiggghtsRun &run = result.runs.front();
  std::printf("\n%d spheres, LIGGGHTS, one core\n", n_grains);
  std::printf("  skin %.2f mean radii (its fastest here), %d steps after %d\n", result.skin, result.n_steps,
              Liggghts::warm_up_steps);
  std::printf("  neighbours %.0f, contacts %.0f, coordination %.3f, rebuilds %.0f, pair forces %.0f %% of the time\n",
              run.n_neighbours, run.n_contacts, 2. * run.n_contacts / n_grains, run.n_builds, 100. * run.pair_share);
  std::printf("  %-38s %12s %12s %12s\n", "", "min", "median", "max");
  print_spread("particle-steps per second and core", rate(result, n_grains));
  print_spread("ns per contact and step", contact_time(result));
}

ordered_json to_json(const Spread &s)
{
  return {{"min", s.least}, {"median", s.median}, {"max", s.most}};
}

ordered_json to_json(const EngineResult &result, const int n_grains)
{
  const PackingFigures &p = result.packing;
  const StepTiming &run = result.runs.front();
  ordered_json json{{"packing",
                     {{"solid_fraction", p.solid_fraction},
                      {"coordination_number", p.coordination_number},
                      {"unbalanced_force", p.unbalanced_force},
                      {"pressure", p.pressure}}},
                    {"threads", result.n_threads},
                    {"steps", run.n_steps},
                    {"repeats", result.runs.size()},
                    {"time_step", result.time_step},
                    {"stable_time_step", result.stable_time_step},
                    {"verlet_pairs", run.n_pairs},
                    {"contacts", run.n_contacts},
                    {"coordination_number", 2. * run.n_contacts / n_grains},
                    {"rebuilds", run.n_rebuilds},
                    {"bytes_per_grain_and_step", double(run.bytes.sum()) / n_grains},
                    {"searches_per_contact_and_step", searches_per_contact(run)},
                    {"particle_steps_per_second_and_core", to_json(rate(result, n_grains))},
                    {"ns_per_contact_and_step", to_json(contact_time(result))}};
  ordered_json shares = ordered_json::object();
  for (const Phase &phase : phase_shares(result.runs))
    shares[phase.name] = phase.seconds;
  json["phase_shares"] = shares;
  return json;
}

ordered_json to_json(const LiggghtsResult &result, const int n_grains)
{
  const LiggghtsRun &run = result.runs.front();
  return {{"steps", result.n_steps},
          {"warm_up_steps", Liggghts::warm_up_steps},
          {"repeats", result.runs.size()},
          {"skin_over_mean_radius", result.skin},
          {"neighbours", run.n_neighbours},
          {"contacts", run.n_contacts},
          {"coordination_number", 2. * run.n_contacts / n_grains},
          {"rebuilds", run.n_builds},
          {"pair_share", run.pair_share},
          {"particle_steps_per_second_and_core", to_json(rate(result, n_grains))},
          {"ns_per_contact_and_step", to_json(contact_time(result))}};
}

ordered_json or_null(const std::optional<double> &value)
{
  return value ? ordered_json(*value) : ordered_json(nullptr);
}

} // namespace

void print(const SizeResult &result)
{
  for (const EngineResult &engine : result.engine)
    print(engine, result.n_grains);
  if (result.liggghts)
    print(*result.liggghts, result.n_grains);
  std::printf("\n");
  for (const GrainKind kind : all_kinds)
    if (const auto value = ratio(result, kind))
      std::printf("%d grains: %s = %.3f\n", result.n_grains, ratio_name(kind).c_str(), *value);
  std::fflush(stdout);
}

ordered_json to_json(const std::vector<SizeResult> &results)
{
  constexpr int headline_grains = 4000;
  ordered_json json;
  json["program"] = "dense_packing";
  for (const GrainKind kind : all_kinds)
    json[ratio_name(kind)] = nullptr;
  json["sizes"] = ordered_json::array();
  for (const SizeResult &result : results)
  {
    ordered_json size{{"grains", result.n_grains}};
    for (const GrainKind kind : all_kinds)
    {
      const ordered_json value = or_null(ratio(result, kind));
      size[ratio_name(kind)] = value;
      if (result.n_grains == headline_grains)
        json[ratio_name(kind)] = value;
    }
    for (const EngineResult &engine : result.engine)
      size[name(engine.kind)] = to_json(engine, result.n_grains);
    if (result.liggghts)
      size["liggghts_spheres"] = to_json(*result.liggghts, result.n_grains);
    json["sizes"].push_back(size);
  }
  return json;
}

} // namespace bergamo::benchmark
