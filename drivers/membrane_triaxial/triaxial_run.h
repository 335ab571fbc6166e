#pragma once

#include "drivers/common/run/picture_series.h"
#include "drivers/common/run/run.h"
#include "drivers/common/run/stable_step_watch.h"
#include "drivers/membrane_triaxial/sample.h"

#include <memory>
#include <string>
#include <vector>

namespace bergamo::driver
{

/// One run: a sample is made in the mould, the membrane takes its place, pressure loads it and plates compress it.
class MembraneTriaxialRun
{
public:
  MembraneTriaxialRun(const MembraneTriaxialParameters &parameters, const CommandLine &command_line,
                      const std::string &parameter_text);

  int go(); ///< @return the exit status

private:
  enum class Part : std::int64_t
  {
    filling,
    shrinking,
    loading,
    compressing
  };

  void visit(StateVisitor &visit);
  bool make_sample();
  bool fill_mould();
  void read_sample(); // from a file, before any work
  Snapshot sample_in(const std::filesystem::path &path) const;
  void begin_test(std::unique_ptr<dem::Simulation> grains);
  void visit_sample(StateVisitor &visit, std::unique_ptr<dem::Simulation> &grains);
  bool load();
  bool compress();
  Stage stage_of(const std::string &name, std::int64_t n_steps); // of the test
  void begin(Part next);
  void look_at_load(double time);
  Summary summary() const;

  const MembraneTriaxialParameters &parameters;
  Run run;
  Part part = Part::filling;
  Mould mould;
  Prism prism; // in which the membrane took the mould's place
  std::unique_ptr<TriaxialCell> cell;
  SampleStart start; // of the present part
  dem::MeanGrain grain;
  double n_looks_passed = 0.; // at the load, in a row
  CellSample now;             // the last one
  TestFigures figures;
  PictureSeries pictures;
  StableStepWatch stable_step{"Test/time step"};
};

} // namespace bergamo::driver
