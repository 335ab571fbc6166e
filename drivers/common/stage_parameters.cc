#include "drivers/common/stage_parameters.h"

#include "drivers/common/grain_parameters.h"

namespace bergamo::driver
{

dem::LoadingStage StageParameters::stage() const
{
  using dem::LoadingPath;
  dem::LoadingStage stage = settings;
  switch (path)
  {
  case StagePath::triaxial:
    stage.path = LoadingPath::triaxial;
    break;
  case StagePath::true_triaxial:
    stage.path = LoadingPath::true_triaxial;
    break;
  case StagePath::constant_volume:
    stage.path = LoadingPath::constant_volume;
    break;
  case StagePath::constant_pressure:
    stage.path = LoadingPath::constant_pressure;
    break;
  default:
    stage.path = LoadingPath::isotropic;
  }
  return stage;
}

void StageParameters::declare(ParameterFile &file, const std::string &section)
{
  file.add(section, "path", path,
           "of the loading; none ends the program. triaxial: strained along z, the pressure across kept; true "
           "triaxial: a stress on every axis; constant volume, constant pressure: strained along z",
           {{"none", StagePath::none},
            {"isotropic", StagePath::isotropic},
            {"triaxial", StagePath::triaxial},
            {"true triaxial", StagePath::true_triaxial},
            {"constant volume", StagePath::constant_volume},
            {"constant pressure", StagePath::constant_pressure}});
  file.add(section, "pressure", settings.pressure, "0: the sample's confining pressure [Pa]",
           Range::non_negative().usual(100, 1e9));
  file.add(section, "stresses", {settings.stresses.data(), 3}, "of true triaxial loading, compression positive [Pa]",
           Range::non_negative().usual(100, 1e9));
  file.add(section, "friction", settings.friction, "between grains", Range::non_negative().usual(0, 2));
  file.add(section, "axial strain", settings.axial_strain, "along z since the start of the stage; compression is < 0",
           Range::any().usual(-0.9, 0.9));
  file.add(section, "cycles", settings.n_cycles,
           "of the axial strain: to the one above, to its opposite and so on, and back; 0 goes there once",
           Range::between(0, 1000000));
  declare_stage_end(file, section, settings);
}

void declare_stage_end(ParameterFile &file, const std::string &section, dem::LoadingStage &stage)
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

} // namespace bergamo::driver
