#pragma once

#include "drivers/common/run/energy_residual.h"
#include "drivers/common/run/picture_series.h"
#include "drivers/common/run/stable_step_watch.h"
#include "drivers/two_scale_triaxial/specimen.h"

#include <memory>
#include <optional>
#include <string>

namespace bergamo::driver
{

/// One run of the test: packing, loading, files.
class TriaxialRun
{
public:
  TriaxialRun(const TriaxialParameters &parameters, const CommandLine &command_line, const std::string &parameter_text);

  int go(); ///< @return the exit status

private:
  double time() const { return run.loop().step() * parameters.simulation.time_step; } // of the loading [s]
  void visit(StateVisitor &visit);
  bool pack();
  bool load();
  Summary summary() const;

  const TriaxialParameters &parameters;
  Run run;
  std::optional<PackingStage> packing;
  LoadingStart start;
  std::unique_ptr<Specimen> specimen;
  std::int64_t packing_steps = 0;
  PictureSeries pictures;
  StableStepWatch stable_step{"Loading/time step"};
  SpecimenSample now; // the last one
  EnergyResidual residual;
  double largest_overlap = 0.; // over the smaller radius
  const Table table = now.table();
};

} // namespace bergamo::driver
