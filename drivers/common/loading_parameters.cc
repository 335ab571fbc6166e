#include "drivers/common/loading_parameters.h"

namespace bergamo::driver
{

void declare_compression(ParameterFile &file, dem::CompressionParameters &compression)
{
  file.add("Packing", "pressure", compression.pressure, "isotropic pressure of the packing [Pa]",
           Range::positive().usual(100, 1e9));
  file.add("Packing", "largest strain rate", compression.largest_rate,
           "of the walls, which are no faster than the pressure could push the grains [1/s]",
           {.lowest = 0, .highest = 1000, .lowest_included = false});
  file.add("Packing", "pressure tolerance", compression.pressure_tolerance, "relative", Range::strictly_between(0, 1));
  file.add("Packing", "force tolerance", compression.force_tolerance, "mean unbalanced over mean contact force",
           Range::strictly_between(0, 1));
  file.add("Packing", "longest time", compression.longest_time, "simulated, then the compression has failed [s]",
           Range::positive());
}

void declare_strain_program(ParameterFile &file, dem::StrainProgram &program)
{
  file.add("Loading", "isotropic volumetric strain", program.isotropic_volumetric_strain, "compression is negative",
           Range::any().usual(-0.5, 0.5));
  file.add("Loading", "isotropic time", program.isotropic_time, "[s]", Range::positive());
  file.add("Loading", "path", program.path, "of the shear phase",
           {{"unloading", dem::StrainPath::unloading},
            {"constant volume", dem::StrainPath::constant_volume},
            {"compression", dem::StrainPath::compression}});
  file.add("Loading", "axis", program.axis, "of the largest compression in the shear phase",
           {{"x", dem::StrainAxis::x}, {"y", dem::StrainAxis::y}, {"z", dem::StrainAxis::z}});
  file.add("Loading", "axial strain", program.axial_strain, "along the axis in the shear phase",
           Range::any().usual(-0.9, 0.9));
  file.add("Loading", "volumetric strain change", program.volumetric_strain_change,
           "size of the change in the shear phase; without meaning at constant volume",
           Range::non_negative().usual(0, 0.5));
  file.add("Loading", "shear time", program.shear_time, "[s]", Range::positive());
  file.add("Loading", "ramp", program.ramp, "share of a phase in which it speeds up, and again slows down",
           {.lowest = 0, .highest = 0.5, .lowest_included = false});
}

} // namespace bergamo::driver
