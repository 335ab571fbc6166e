#pragma once

#include "drivers/common/run/energy_residual.h"
#include "drivers/common/run/picture_series.h"
#include "drivers/common/run/run.h"
#include "drivers/common/run/settled_sand.h"
#include "drivers/common/run/stable_step_watch.h"
#include "drivers/rubber_block/figures.h"
#include "drivers/rubber_block/tables.h"

#include <memory>
#include <string>

namespace bergamo::driver
{

/// One run: sand that settles, and the block on it.
class BlockRun
{
public:
  BlockRun(const RubberBlockParameters &parameters, const CommandLine &command_line, const std::string &parameter_text);

  int go(); ///< @return the exit status

private:
  void visit(StateVisitor &visit);
  bool settle();
  bool pull_block();
  void sample(History &history, History &pressures);
  void draw(PictureSeries &series, bool of_grains);
  Summary summary() const;

  const RubberBlockParameters &parameters;
  Run run;
  std::unique_ptr<dem::Simulation> sand; // until it has settled
  std::unique_ptr<Pull> pull;            // then
  SettledSand settled;
  BlockFigures figures;
  BlockSample now; // the last one
  PictureSeries pictures, grain_pictures;
  EnergyResidual residual;
  StableStepWatch stable_step{"Pull/time step"};
  const Table table = now.table(pull);
  const Table strips = pressure_table(now.time, pull, parameters.block.n_along);
};

} // namespace bergamo::driver
