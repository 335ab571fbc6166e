#pragma once

#include "dem/loading/loading_stage.h"
#include "drivers/common/parameter_file.h"

#include <string>

namespace bergamo::driver
{

/// The path of a stage as the parameter file has it.
enum class StagePath
{
  none,
  isotropic,
  triaxial,
  true_triaxial,
  constant_volume,
  constant_pressure
};

/// A stage of a periodic cell's program; the pressure 0 stands for one that the driver knows.
struct StageParameters
{
  StagePath path = StagePath::none;
  dem::LoadingStage settings; ///< but for the path

  bool is_used() const { return path != StagePath::none; }

  /// The stage with its path, which is one.
  dem::LoadingStage stage() const;

  /// Binds all to a section.
  void declare(ParameterFile &file, const std::string &section);
};

/// Binds what every stage has: its speed, its step, and what ends it.
void declare_stage_end(ParameterFile &file, const std::string &section, dem::LoadingStage &stage);

} // namespace bergamo::driver
