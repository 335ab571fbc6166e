#pragma once

#include "drivers/common/parameter_file.h"

#include <string>

namespace bergamo::driver
{

/// How much a run writes.
struct OutputParameters
{
  unsigned int n_samples = 200; ///< rows of history.csv
  unsigned int n_pictures = 5;
  double snapshot_interval = 30; ///< wall clock [s]

  /// Binds them to the section "Output". @param shown in the pictures, with its verb: "the mesh is"
  void declare(ParameterFile &file, const std::string &shown);
};

} // namespace bergamo::driver
