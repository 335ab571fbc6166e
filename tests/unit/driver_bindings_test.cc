#include "drivers/common/continuum_parameters.h"
#include "drivers/common/coupling_parameters.h"
#include "drivers/common/grading_parameters.h"
#include "drivers/common/grain_parameters.h"
#include "drivers/common/loading_parameters.h"
#include "drivers/common/output_parameters.h"
#include "drivers/common/stage_parameters.h"

#include <catch2/catch.hpp>

#include <string>
#include <utility>
#include <variant>

using namespace bergamo;
using namespace bergamo::driver;

TEST_CASE("parameters of the library get what the file says")
{
  dem::CompressionParameters compression;
  dem::StrainProgram program;
  coupling::CouplingParameters coupling;
  OutputParameters output;
  ParameterFile file("test");
  declare_compression(file, compression);
  declare_strain_program(file, program);
  declare_coupling(file, coupling);
  output.declare(file, "the mesh is");
  for (const char *assignment :
       {"Packing/pressure=2", "Packing/largest strain rate=3", "Packing/pressure tolerance=0.4",
        "Packing/force tolerance=0.5", "Packing/longest time=6", "Loading/isotropic volumetric strain=-0.1",
        "Loading/isotropic time=2", "Loading/path=unloading", "Loading/axis=x", "Loading/axial strain=-0.3",
        "Loading/volumetric strain change=0.4", "Loading/shear time=5", "Loading/ramp=0.25", "Coupling/penalty=2",
        "Coupling/projection=consistent", "Coupling/least weight=0.5", "Output/samples=2", "Output/pictures=3",
        "Output/snapshot interval=4"})
    file.set(assignment);

  CHECK(compression.pressure == 2.);
  CHECK(compression.largest_rate == 3.);
  CHECK(compression.pressure_tolerance == 0.4);
  CHECK(compression.force_tolerance == 0.5);
  CHECK(compression.longest_time == 6.);
  CHECK(program.isotropic_volumetric_strain == -0.1);
  CHECK(program.isotropic_time == 2.);
  CHECK(program.path == dem::StrainPath::unloading);
  CHECK(program.axis == dem::StrainAxis::x);
  CHECK(program.axial_strain == -0.3);
  CHECK(program.volumetric_strain_change == 0.4);
  CHECK(program.shear_time == 5.);
  CHECK(program.ramp == 0.25);
  CHECK(coupling.penalty == 2.);
  CHECK(coupling.projection == coupling::Projection::consistent);
  CHECK(coupling.least_weight == 0.5);
  CHECK(output.n_samples == 2);
  CHECK(output.n_pictures == 3);
  CHECK(output.snapshot_interval == 4.);
}

TEST_CASE("a stage goes the path that the file names")
{
  StageParameters parameters;
  ParameterFile file("test");
  parameters.declare(file, "Stage 1");
  CHECK_FALSE(parameters.is_used());
  using dem::LoadingPath;
  for (const auto &[name, path] : {std::pair{"isotropic", LoadingPath::isotropic},
                                   {"triaxial", LoadingPath::triaxial},
                                   {"true triaxial", LoadingPath::true_triaxial},
                                   {"constant volume", LoadingPath::constant_volume},
                                   {"constant pressure", LoadingPath::constant_pressure}})
  {
    file.set(std::string("Stage 1/path=") + name);
    CHECK(parameters.is_used());
    CHECK(parameters.stage().path == path);
  }
}

TEST_CASE("uniform sizes get what the file says")
{
  GradingParameters sizes;
  ParameterFile file("test");
  sizes.declare(file);
  for (const char *assignment :
       {"Grains/sizes=uniform", "Grains/Uniform/smallest diameter=0.25", "Grains/Uniform/largest diameter=0.5",
        "Grains/Shapes/elongation=2", "Grains/Shapes/angularity=0.125"})
    file.set(assignment);
  const auto uniform = std::get<dem::UniformSizes>(sizes.grading());
  CHECK(uniform.smallest_diameter == 0.25);
  CHECK(uniform.largest_diameter == 0.5);
  CHECK(uniform.shapes.elongation == 2.);
  CHECK(uniform.shapes.angularity == 0.125);
}

TEST_CASE("a material gets what the file says, in its own section")
{
  ContinuumParameters first, second;
  ParameterFile file("test");
  first.declare(file);
  second.declare(file, "Layer 2");
  for (const char *assignment :
       {"Layer 2/law=hypoplastic sand", "Layer 2/Young's modulus=2e6", "Layer 2/Poisson's ratio=0.1",
        "Layer 2/friction angle=30", "Layer 2/dilation angle=4", "Layer 2/cohesion=5", "Layer 2/reference pressure=6",
        "Layer 2/stiffness exponent=0.7", "Layer 2/density=8", "Layer 2/Sand/void ratio=0.9", "Continuum/density=10"})
    file.set(assignment);
  CHECK(second.is_sand());
  CHECK(second.mohr_coulomb.young_modulus == 2e6);
  CHECK(second.mohr_coulomb.poisson_ratio == 0.1);
  CHECK(second.mohr_coulomb.friction_angle == 30);
  CHECK(second.mohr_coulomb.dilation_angle == 4);
  CHECK(second.mohr_coulomb.cohesion == 5);
  CHECK(second.mohr_coulomb.reference_pressure == 6);
  CHECK(second.mohr_coulomb.stiffness_exponent == 0.7);
  CHECK(second.density() == 8);
  CHECK(second.sand.initial_void_ratio == 0.9);
  CHECK_FALSE(first.is_sand());
  CHECK(first.density() == 10);
}

TEST_CASE("grains get what the file says")
{
  dem::GrainDistribution sizes;
  ParameterFile file("test");
  declare_distribution(file, "Grains", sizes);
  for (const char *assignment :
       {"Grains/mean half-axes=1, 2, 3", "Grains/relative deviation=0.4", "Grains/smallest half-axis=0.5",
        "Grains/largest half-axis=6", "Grains/smallest exponent=0.7", "Grains/largest exponent=1.8"})
    file.set(assignment);
  CHECK(sizes.mean_half_axes == Vec3(1, 2, 3));
  CHECK(sizes.relative_deviation == 0.4);
  CHECK(sizes.smallest_half_axis == 0.5);
  CHECK(sizes.largest_half_axis == 6);
  CHECK(sizes.smallest_exponent == 0.7);
  CHECK(sizes.largest_exponent == 1.8);
}
