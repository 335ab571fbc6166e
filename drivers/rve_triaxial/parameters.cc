#include "drivers/rve_triaxial/parameters.h"

#include "dem/core/error.h"
#include "drivers/common/grain_parameters.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

namespace bergamo::driver
{

using dem::LoadingPath;

RveParameters::RveParameters()
{
  generation.pressure = 1e3;
  generation.inertial_number = 1e-2;
  generation.overlap_tolerance = 5e-2; // light contacts of grains that jostle one another
  for (StageSettings &s : stages)
  {
    s.stage.pressure = 0.;
    s.stage.overlap_tolerance = 1e-2; // the same curves as 1e-4, in 0.6 of the time
  }
  stages[1].stage.inertial_number = 1e-3;
  stages[1].stage.axial_strain = -0.25;
  path_names.fill("none");
  path_names[0] = "isotropic";
  path_names[1] = "triaxial";
}

namespace
{

/// What all stages have.
void declare_end(ParameterFile &file, const std::string &section, dem::LoadingStage &stage)
{
  file.add(section, "inertial number", stage.inertial_number, "of the strain rate",
           {.lowest = 0, .highest = 0.1, .lowest_included = false});
  file.add(section, "time step", stage.time_step, "at most, and a fifth below the stable one [s]", Range::positive());
  declare_overlap_tolerance(file, section, stage.overlap_tolerance);
  file.add(section, "stress tolerance", stage.stress_tolerance, "over the pressure", Range::strictly_between(0, 1));
  file.add(section, "force tolerance", stage.force_tolerance, "mean unbalanced over mean contact force at the end",
           Range::strictly_between(0, 1));
  file.add(section, "longest time", stage.longest_time, "simulated, then the stage has failed [s]", Range::positive());
}

constexpr std::array<std::pair<const char *, LoadingPath>, 5> paths{
    {{"isotropic", LoadingPath::isotropic},
     {"triaxial", LoadingPath::triaxial},
     {"true triaxial", LoadingPath::true_triaxial},
     {"constant volume", LoadingPath::constant_volume},
     {"constant pressure", LoadingPath::constant_pressure}}};

/// A seed of its own for every packing, exact as a double in ensemble.csv (SplitMix64, Steele et al. 2014).
std::uint64_t mixed_seed(std::uint64_t value)
{
  value += 0x9e3779b97f4a7c15u;
  value = (value ^ value >> 30) * 0xbf58476d1ce4e5b9u;
  value = (value ^ value >> 27) * 0x94d049bb133111ebu;
  return (value ^ value >> 31) >> 11;
}

} // namespace

void RveParameters::declare(ParameterFile &file)
{
  file.add("Ensemble", "samples", n_samples, "of each combination of the lists below", Range::between(1, 10000));
  file.add("Ensemble", "seed", seed, "of the first sample; the others follow");
  file.add("Ensemble", "edges", edges, "of the periodic cells before their compression [m]", Range::positive());
  file.add("Ensemble", "generation frictions", generation_frictions,
           "between grains while a packing is compressed: less gives denser packings", Range::non_negative());
  file.add("Ensemble", "confining pressures", confining_pressures, "[Pa]", Range::positive());

  file.add("Grains", "sizes", size_kind, "which of the three sections below counts",
           {{"gaussian", SizeKind::gaussian}, {"uniform", SizeKind::uniform}, {"sieves", SizeKind::sieves}});
  declare_distribution(file, "Grains/Gaussian", gaussian);
  file.add("Grains/Uniform", "smallest diameter", uniform.smallest_diameter, "of the sphere of equal volume [m]",
           Range::positive());
  file.add("Grains/Uniform", "largest diameter", uniform.largest_diameter, "[m]", Range::positive());
  file.add("Grains/Sieves", "d10", d10, "opening that a tenth of the mass passes [m]", Range::positive());
  file.add("Grains/Sieves", "d50", d50, "[m]", Range::positive());
  file.add("Grains/Sieves", "d60", d60, "[m]", Range::positive());
  file.add("Grains/Shapes", "elongation", uniform.shapes.elongation,
           "largest ratio of two half-axes, for uniform sizes and sieves", Range::at_least(1));
  file.add("Grains/Shapes", "angularity", uniform.shapes.angularity,
           "largest distance of an exponent from 1, for uniform sizes and sieves",
           {.lowest = 0, .highest = 1, .highest_included = false});

  declare_grains(file, simulation);

  file.add("Packing", "solid fraction", packing_solid_fraction, "of the geometric packing, before any contact",
           Range::strictly_between(0, 1));
  file.add("Packing", "pressure", generation.pressure, "of the isotropic compression that follows [Pa]",
           Range::positive());
  declare_end(file, "Packing", generation);

  for (std::size_t k = 0; k < max_stages; ++k)
  {
    const std::string section = "Stage " + std::to_string(k + 1);
    dem::LoadingStage &stage = stages[k].stage;
    file.add(section, "path", path_names[k],
             "of the loading; none ends the program. triaxial: strained along z, the pressure across kept; true "
             "triaxial: a stress on every axis; constant volume, constant pressure: strained along z",
             {"none", "isotropic", "triaxial", "true triaxial", "constant volume", "constant pressure"});
    file.add(section, "pressure", stage.pressure, "0: the sample's confining pressure [Pa]", Range::non_negative());
    file.add(section, "stresses", {stage.stresses.data(), 3}, "of true triaxial loading, compression positive [Pa]",
             Range::non_negative());
    file.add(section, "friction", stage.friction, "between grains", Range::non_negative());
    file.add(section, "axial strain", stage.axial_strain, "along z since the start of the stage; compression is < 0");
    file.add(section, "cycles", stage.n_cycles,
             "of the axial strain: to the one above, to its opposite and so on, and back; 0 goes there once",
             Range::between(0, 1000000));
    declare_end(file, section, stage);
  }

  file.add("Output", "rows", n_rows, "of history.csv in each strained stage", Range::between(2, 1000000));
  file.add("Output", "row interval", row_interval, "steps between rows in stages without a strain of their own",
           Range::between(1, 1000000000));
  file.add("Output", "distributions", n_distributions, "rows of distributions.csv in each strained stage",
           Range::between(1, 100000));
  file.add("Output", "pictures", pictures, "of the grains at the end of every stage, for ParaView");
  file.add("Output", "snapshot interval", snapshot_interval, "wall clock time between snapshots of a sample [s]",
           Range::positive());
}

void RveParameters::take_stages()
{
  for (std::size_t k = 0; k < max_stages; ++k)
  {
    stages[k].is_used = false;
    for (const auto &[name, path] : paths)
      if (path_names[k] == name)
      {
        stages[k].is_used = true;
        stages[k].stage.path = path;
      }
  }
}

void RveParameters::validate() const
{
  const auto fail = [](const std::string &text) { throw ConfigError(text); };
  simulation.validate();
  if (size_kind == SizeKind::gaussian)
    gaussian.validate();
  else if (size_kind == SizeKind::uniform)
    uniform.validate();
  else
    dem::SieveCurve::through(d10, d50, d60, uniform.shapes).validate();
  dem::PackingParameters packing;
  packing.solid_fraction = packing_solid_fraction;
  packing.validate();
  if (edges.empty() || generation_frictions.empty() || confining_pressures.empty())
    fail("Ensemble: the lists of edges, generation frictions and confining pressures need one value each at least");
  for (std::size_t k = 0; k + 1 < max_stages; ++k)
    if (!stages[k].is_used && stages[k + 1].is_used)
      fail("Stage " + std::to_string(k + 1) + "/path is none, but stage " + std::to_string(k + 2) +
           " is not: stages follow one another without a gap");
  for (const SampleSettings &sample : samples())
  {
    for (const dem::LoadingStage &stage : program(sample))
      stage.validate();
    require_room(sample);
  }
}

/// The cell must stay two ranges of contacts wide when the packing is as dense as packings get.
void RveParameters::require_room(const SampleSettings &sample) const
{
  constexpr double densest = 0.74;
  std::mt19937_64 generator(sample.seed);
  double largest = 0., mean = 0.;
  const auto grains = dem::draw_grains(grading(), packing_solid_fraction * std::pow(sample.edge, 3), generator);
  for (const dem::Superquadric &grain : grains)
  {
    const double radius = dem::bounding_radius(grain);
    largest = std::max(largest, radius);
    mean += radius / static_cast<double>(grains.size());
  }
  const double shrinking = std::cbrt(std::min(1., packing_solid_fraction / densest));
  const double least = 2. * (2. * largest + simulation.verlet_distance * mean) / shrinking;
  if (grains.empty() || sample.edge < least)
    throw ConfigError("Ensemble/edges: a cell of " + std::to_string(sample.edge) +
                      " m is too small for its grains, which would touch one another twice; it needs " +
                      std::to_string(least) + " m at least: make it larger or the grains smaller");
}

dem::Grading RveParameters::grading() const
{
  switch (size_kind)
  {
  case SizeKind::uniform:
    return uniform;
  case SizeKind::sieves:
    return dem::SieveCurve::through(d10, d50, d60, uniform.shapes);
  default:
    return gaussian;
  }
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
          all.push_back({number, mixed_seed(seed + static_cast<std::uint64_t>(k)), edge, friction, pressure});
        }
  return all;
}

std::vector<dem::LoadingStage> RveParameters::program(const SampleSettings &sample) const
{
  std::vector<dem::LoadingStage> program{generation};
  program[0].friction = sample.generation_friction;
  for (const StageSettings &settings : stages)
    if (settings.is_used)
    {
      program.push_back(settings.stage);
      if (program.back().pressure == 0.)
        program.back().pressure = sample.confining_pressure;
    }
  return program;
}

} // namespace bergamo::driver
