// What a triaxial test on a periodic cell gives where contacts across its faces do not see the velocity of the image,
// dL/dt, a fault that the program does not have and others may: still_images.patch takes it from the force laws. One
// sample as rve_triaxial makes it: generation, pressure, compression along z by a quarter. `image_velocity --help`.

#include "benchmarks/program.h"
#include "dem/core/error.h"
#include "dem/force/pair_motion.h" // patched
#include "dem/loading/cell_loading.h"
#include "dem/measure/coordination.h"
#include "dem/measure/solid_fraction.h"
#include "dem/packing/pack_grains.h"

#include <cmath>
#include <cstdint>
#include <iostream>
#include <string>
#include <vector>

namespace
{

using namespace bergamo;
using namespace bergamo::benchmark;

struct Sample
{
  double edge = 0.01;                ///< of the cell before its generation [m]
  std::uint64_t seed = 1;            ///< of the packing
  double generation_friction = 0.08; ///< between grains
  bool generates_still = false;      ///< images stand still while the sample is generated
  bool shears_still = false;         ///< and from there on
  bool is_sheared = true;
};

/// Figures of the end of a stage.
struct Outcome
{
  double solid_fraction = 0.; ///< over the last percent of a strain
  double stress_ratio = 0.;   ///< sigma_z / sigma_x, over the last percent of a strain
};

dem::Simulation pack(const Sample &sample)
{
  const Vec3 edges = Vec3::Constant(sample.edge);
  const dem::PackingSpace space = dem::PackingSpace::periodic({Vec3::Zero(), edges});
  dem::PackedGrains packed = dem::pack_grains(dem::GrainDistribution(), space, {}, sample.seed);
  if (!packed.report.has_reached_target)
    throw RunError("the geometric packing got stuck; choose another seed");
  packed.particles.cell = dem::PeriodicCell(edges);
  dem::SimulationParameters parameters;
  parameters.contact.overlap_tolerance = 1e-2;
  return {parameters, std::move(packed.particles), {}};
}

dem::LoadingStage generation(const double friction)
{
  dem::LoadingStage stage;
  stage.friction = friction;
  stage.pressure = 1e3;
  stage.inertial_number = 1e-2;
  stage.overlap_tolerance = 5e-2;
  return stage;
}

dem::LoadingStage confinement()
{
  dem::LoadingStage stage;
  stage.overlap_tolerance = 1e-2;
  return stage;
}

dem::LoadingStage compression()
{
  dem::LoadingStage stage = confinement();
  stage.path = dem::LoadingPath::triaxial;
  stage.axial_strain = -0.25;
  return stage;
}

Outcome run(dem::Simulation &simulation, const dem::LoadingStage &stage, const bool still)
{
  dem::images_stand_still = still;
  dem::CellLoading loading(stage, dem::mean_grain(simulation.particles), simulation.parameters().grain().density);
  loading.begin(simulation);
  const double solid_volume = dem::solid_volume(simulation.particles);
  Outcome sum, last;
  double n = 0.;
  for (bool is_last = false; !is_last;)
  {
    loading.prepare(simulation);
    is_last = loading.is_finished();
    const Vec3 stress = simulation.cell_stress();
    last = {solid_volume / simulation.particles.cell.volume(), 2. * stress[2] / (stress[0] + stress[1])};
    if (stage.is_strained() && loading.strain(simulation)[2] < stage.axial_strain + 0.01)
    {
      sum.solid_fraction += last.solid_fraction;
      sum.stress_ratio += last.stress_ratio;
      n += 1.;
    }
    simulation.integrate();
  }
  return n == 0. ? last : Outcome{sum.solid_fraction / n, sum.stress_ratio / n};
}

void measure(const Sample &sample)
{
  dem::Simulation simulation = pack(sample);
  const Outcome generated = run(simulation, generation(sample.generation_friction), sample.generates_still);
  const double coordination = dem::mean_coordination(simulation.contacts, simulation.particles.size());
  std::cout << sample.edge << ',' << sample.seed << ',' << simulation.particles.size() << ','
            << sample.generation_friction << ',' << sample.generates_still << ',' << sample.shears_still << ','
            << generated.solid_fraction << ',' << coordination;
  if (sample.is_sheared)
  {
    const Outcome confined = run(simulation, confinement(), sample.shears_still);
    const Outcome sheared = run(simulation, compression(), sample.shears_still);
    std::cout << ',' << confined.solid_fraction << ',' << sheared.stress_ratio << ',' << sheared.solid_fraction;
  }
  std::cout << std::endl;
}

} // namespace

int main(const int argc, char **const argv)
{
  return run_program(
      "image_velocity",
      [&]
      {
        Sample sample;
        CLI::App app(
            "A triaxial test on a periodic cell whose contacts across the faces may not see the velocity of the "
            "image. Prints edge, seed, grains, friction, generates still, shears still, solid fraction and "
            "contacts a grain as generated, then solid fraction under 25 kPa, stress ratio and solid fraction "
            "at the end.",
            "image_velocity");
        app.add_option("--edge", sample.edge, "Of the cell [m] (default: 0.01)")->check(CLI::PositiveNumber);
        app.add_option("--seed", sample.seed, "Of the packing (default: 1)");
        app.add_option("--friction", sample.generation_friction, "While the sample is generated (default: 0.08)")
            ->check(CLI::NonNegativeNumber);
        app.add_flag("--generate-still", sample.generates_still, "Images stand still while it is generated");
        app.add_flag("--shear-still", sample.shears_still, "Images stand still from there on");
        app.add_flag("!--generate-only", sample.is_sheared, "Ends with the generation");
        if (parse_arguments(app, argc, argv))
          measure(sample);
      });
}
