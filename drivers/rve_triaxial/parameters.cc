#include "drivers/rve_triaxial/parameters.h"

#include "dem/core/error.h"
#include "dem/loading/cell_room.h"
#include "dem/packing/random_stream.h"
#include "drivers/common/grain_parameters.h"
#include "drivers/common/number_text.h"

#include <cmath>
#include <string>

namespace bergamo::driver
{

RveParameters::RveParameters()
{
  generation.pressure = 1e3;
  generation.inertial_number = 1e-2;
  generation.overlap_tolerance = 5e-2; // light contacts of grains that jostle one another
  for (StageParameters &s : stages)
  {
    s.settings.pressure = 0.;
    s.settings.overlap_tolerance = 1e-2; // the same curves as 1e-4, in 0.6 of the time
  }
  stages[0].path = StagePath::isotropic;
  stages[1].path = StagePath::triaxial;
  stages[1].settings.inertial_number = 1e-3;
  stages[1].settings.axial_strain = -0.25;
}

void RveParameters::declare(ParameterFile &file)
{
  file.add("Ensemble", "samples", n_samples, "of each combination of the lists below", Range::between(1, 10000));
  file.add("Ensemble", "seed", seed, "of the first sample; the others follow");
  file.add("Ensemble", "edges", edges, "of the periodic cells before their compression [m]",
           Range::positive().usual(1e-4, 10));
  file.add("Ensemble", "generation frictions", generation_frictions,
           "between grains while a packing is compressed: less gives denser packings",
           Range::non_negative().usual(0, 2));
  file.add("Ensemble", "confining pressures", confining_pressures, "[Pa]", Range::positive().usual(100, 1e9));

  sizes.declare(file);
  declare_grains(file, simulation);

  file.add("Packing", "solid fraction", packing_solid_fraction, "of the geometric packing, before any contact",
           Range::strictly_between(0, 1));
  file.add("Packing", "pressure", generation.pressure, "of the isotropic compression that follows [Pa]",
           Range::positive().usual(100, 1e9));
  declare_stage_end(file, "Packing", generation);

  for (std::size_t k = 0; k < max_stages; ++k)
    stages[k].declare(file, "Stage " + std::to_string(k + 1));

  file.add("Output", "rows", n_rows, "of history.csv in each strained stage", Range::between(2, 1000000));
  file.add("Output", "row interval", row_interval, "steps between rows in stages without a strain of their own",
           Range::between(1, 1000000000));
  file.add("Output", "distributions", n_distributions, "rows of distributions.csv in each strained stage",
           Range::between(1, 100000));
  file.add("Output", "pictures", pictures, "of the grains at the end of every stage, for ParaView");
  file.add("Output", "snapshot interval", snapshot_interval, "wall clock time between snapshots of a sample [s]",
           Range::positive());
}

void RveParameters::validate() const
{
  simulation.validate();
  dem::PackingParameters packing;
  packing.solid_fraction = packing_solid_fraction;
  sizes.validate(packing);
  if (edges.empty() || generation_frictions.empty() || confining_pressures.empty())
    reject("Ensemble: the lists of edges, generation frictions and confining pressures need one value each at least");
  for (std::size_t k = 0; k + 1 < max_stages; ++k)
    if (!stages[k].is_used() && stages[k + 1].is_used())
      reject("Stage ", k + 1, "/path is none, but stage ", k + 2, " is not: stages follow one another without a gap");
  for (const SampleSettings &sample : samples())
  {
    for (const dem::LoadingStage &stage : program(sample))
      stage.validate();
    require_room(sample);
  }
}

void RveParameters::require_room(const SampleSettings &sample) const
{
  const dem::Particles grains = sizes.draw(packing_solid_fraction * std::pow(sample.edge, 3), sample.seed);
  const double least = dem::least_uncompressed_edge(grains, packing_solid_fraction, simulation.verlet_distance);
  if (sample.edge <= least)
    reject("Ensemble/edges: a cell of ", sample.edge,
           " m is too small for its grains, which would touch one another twice; it needs more than ", least,
           " m: make it larger or the grains smaller");
}

std::vector<SampleSettings> RveParameters::samples() const
{
  std::vector<SampleSettings> all;
  for (const double edge : edges)
    for (const double friction : generation_frictions)
      for (const double pressure : confining_pressures)
        for (int k = 0; k < n_samples; ++k)
        {
          const auto number = static_cast<std::int64_t>(all.size()) + 1;
          const std::uint64_t first = seed + static_cast<std::uint64_t>(k);
          const std::uint64_t own = dem::RandomStream::mixed(first) >> 11; // as a double
          all.push_back({number, first, own, edge, friction, pressure});
        }
  return all;
}

std::string RveParameters::alone(const SampleSettings &sample) const
{
  const auto option = [](const std::string &name, const std::string &value)
  { return "--set \"Ensemble/" + name + "=" + value + "\""; };
  return option("samples", "1") + " " + option("seed", std::to_string(sample.ensemble_seed)) + " " +
         option("edges", exact_text(sample.edge)) + " " +
         option("generation frictions", exact_text(sample.generation_friction)) + " " +
         option("confining pressures", exact_text(sample.confining_pressure));
}

std::vector<dem::LoadingStage> RveParameters::program(const SampleSettings &sample) const
{
  std::vector<dem::LoadingStage> program{generation};
  program[0].friction = sample.generation_friction;
  for (const StageParameters &settings : stages)
    if (settings.is_used())
    {
      program.push_back(settings.stage());
      if (program.back().pressure == 0.)
        program.back().pressure = sample.confining_pressure;
    }
  return program;
}

} // namespace bergamo::driver
