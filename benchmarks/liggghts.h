#pragma once

#include "benchmarks/child_process.h"
#include "dem/simulation/simulation.h"

#include <filesystem>
#include <string>
#include <vector>

namespace bergamo::benchmark
{

/// What LIGGGHTS tells of a run.
struct LiggghtsRun
{
  double seconds = 0.;    ///< of the measured steps, its "Loop time"
  double n_contacts = 0.; ///< between grains, at the end
  double n_neighbours = 0.;
  double n_builds = 0.;   ///< of the neighbour list, in the measured steps
  double pair_share = 0.; ///< of the time, spent in the contacts between grains
};

/// LIGGGHTS-PUBLIC (Debian's liggghts) on one core as a yardstick: it steps the spheres of a simulation with the same
/// material, law (Hertz, Mindlin with history), walls and time step. Debian builds it without superquadrics.
class Liggghts
{
public:
  static constexpr int warm_up_steps = 300; ///< not measured; contacts and their history exist afterwards

  /// Writes the spheres where they are. @param packing spheres between six walls of a box, see box_walls()
  Liggghts(std::filesystem::path program, const dem::Simulation &packing);

  /// Neighbour skin over the mean radius with which it is fastest here; tries each for some steps.
  double fastest_skin() const;

  /// @param skin over the mean radius; @throws RunError with LIGGGHTS' own words if it fails
  LiggghtsRun run(int n_steps, double skin) const;

private:
  std::string script(int n_steps, double skin) const;

  std::filesystem::path program;
  TemporaryFolder folder;
  dem::SimulationParameters parameters;
  std::vector<dem::PlaneWall> walls;
  double mean_radius = 0.; ///< [m]
};

} // namespace bergamo::benchmark
