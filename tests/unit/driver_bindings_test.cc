#include "drivers/common/coupling_parameters.h"
#include "drivers/common/loading_parameters.h"
#include "drivers/common/output_parameters.h"

#include <catch2/catch.hpp>

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
        "Loading/isotropic time=2", "Loading/path=unloading", "Loading/axial strain=-0.3",
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
