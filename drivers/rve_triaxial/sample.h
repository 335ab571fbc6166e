#pragma once

#include "dem/loading/cell_loading.h"
#include "drivers/common/history.h"
#include "drivers/common/snapshot_timer.h"
#include "drivers/rve_triaxial/parameters.h"

#include <atomic>
#include <chrono>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <string>

namespace bergamo::driver
{

/// What is kept of a sample beside its history: one row of ensemble.csv.
struct SampleFigures
{
  std::int64_t n_particles = 0, n_steps = 0;
  double generated_solid_fraction = 0.; ///< after the generation
  double solid_fraction = 0.;           ///< when the last stage began
  double coordination_number = 0.;      ///< then
  double final_solid_fraction = 0.;
  double final_stress_ratio = 0.; ///< sigma_zz over the mean of the others, at the end
  double energy_residual = 0.;    ///< largest miss of the balance over the work done by the cell
  double largest_overlap = 0.;    ///< over the smaller bounding radius
  double stable_step = std::numeric_limits<double>::infinity(); ///< [s], and the step used then,
  double time_step = 0.;                                        ///< where they came nearest to one another
  std::int64_t n_undecided = 0;
  double wall_time = 0.; ///< [s]

  static std::vector<std::string> names();
  std::vector<double> values() const;
  static SampleFigures from(const std::vector<double> &values);
};

/// Where a sample stands, for others to read while it runs.
struct SampleProgress
{
  std::atomic<double> fraction = 0.;
  std::atomic<std::int64_t> steps_here = 0; ///< done by this process
  std::atomic<std::int64_t> particles = 0;
};

/// One sample: packing, generation, and the stages of the program, in a folder of its own. Goes on from its snapshot
/// where there is one.
class SampleRun
{
public:
  SampleRun(const RveParameters &parameters, const SampleSettings &settings, std::filesystem::path folder,
            std::string parameter_text, SampleProgress &progress);

  /// @return false if the user stopped it, after a snapshot. @throws RunError naming the sample
  bool run();

  const SampleFigures &figures() const { return f; }

private:
  void begin();
  void read_snapshot();
  void write_snapshot() const;
  void begin_stage();
  void end_stage();
  void record();
  void record_distributions(double time);
  std::int64_t steps_to_next_row() const;

  using Clock = std::chrono::steady_clock;

  const RveParameters &parameters;
  SampleSettings settings;
  std::filesystem::path folder;
  std::string parameter_text;
  SampleProgress &progress;

  std::vector<dem::LoadingStage> program;
  dem::MeanGrain grain;
  double solid_volume = 0.; ///< [m^3]
  std::unique_ptr<dem::Simulation> simulation;
  std::optional<dem::CellLoading> loading;
  std::optional<History> history, distributions;
  std::int64_t stage = 0;                           ///< under way
  std::int64_t next_row = 0, next_distribution = 0; ///< steps
  double first_balance = 0.;                        ///< of the energy [J]
  SampleFigures f;
  double wall_time_before = 0.; ///< spent by earlier processes [s]
  Clock::time_point start = Clock::now();
  SnapshotTimer snapshot_timer;
};

} // namespace bergamo::driver
