#pragma once

#include "drivers/common/run/picture_series.h"
#include "drivers/common/run/run.h"
#include "drivers/common/run/stable_step_watch.h"
#include "drivers/silo_discharge/discharge.h"
#include "drivers/silo_discharge/filling.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace bergamo::driver
{

/// One filling, and then one discharge of the filled silo after the other.
class SiloRun
{
public:
  SiloRun(const SiloParameters &parameters, const CommandLine &command_line, const std::string &parameter_text);

  int go();

private:
  std::filesystem::path folder() const;
  void visit(StateVisitor &visit);
  void visit_filling(StateVisitor &visit);
  bool fill();
  bool discharge();
  void open_next();
  Stage stage_of(dem::Simulation &grains) const;

  const SiloParameters &parameters;
  Run run;
  Snapshot filled; // what every discharge begins with
  std::unique_ptr<Filling> filling;
  std::int64_t is_filled = 0;
  FillingFigures filling_figures;
  std::vector<DischargeFigures> done;
  std::unique_ptr<Discharge> present;
  std::unique_ptr<PictureSeries> pictures;
  StableStepWatch stable_step{"Output/time step"};
};

} // namespace bergamo::driver
