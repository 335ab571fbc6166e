#pragma once

#include "dem/simulation/simulation.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

namespace bergamo::benchmark
{

/// Sand that flows through an hourglass (Wellmann, fig. 3.15): two cones of 30 degrees to the vertical, neck to neck,
/// below a cylinder, all of fixed spheres that leave no gap, on a floor. The grains are put at random into the upper
/// cone and fall and flow at once.
struct HourglassRecipe
{
  int n_grains = 100000;     ///< about so many
  double neck_radius = 4e-3; ///< [m]; some seven grain lengths across, so that it does not clog
  /// Softer than sand, as is usual for flow: the time step grows, and the overlap stays below a hundredth.
  double young_modulus = 1e7; ///< [Pa]
  double flow_time = 0.05;    ///< after which the sand flows [s]
};

/// State of the flow.
struct FlowFigures
{
  int n_grains = 0, n_wall_spheres = 0;
  double coordination_number = 0.; ///< of the free grains
  double mean_speed = 0.;          ///< [m/s]
  double share_below_neck = 0.;
};

FlowFigures flow_figures(const dem::Simulation &simulation);

/// @param log is given a line now and then
std::unique_ptr<dem::Simulation> flowing_hourglass(const HourglassRecipe &recipe,
                                                   const std::function<void(const std::string &)> &log);

/// The same from a folder, or made and then kept there. A file that this version cannot read, or that does not give
/// back the flow it was written in, is replaced. @throws RunError if the folder cannot be written to
std::unique_ptr<dem::Simulation> cached_hourglass(const std::filesystem::path &folder, const HourglassRecipe &recipe,
                                                  const std::function<void(const std::string &)> &log);

} // namespace bergamo::benchmark
