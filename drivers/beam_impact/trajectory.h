#pragma once

#include <vector>

namespace bergamo::driver
{

/// Motion of sphere and beam and what they exert on one another, at equal steps of time from the first touch on.
struct Trajectory
{
  std::vector<double> sphere; ///< displacement towards the beam [m]
  std::vector<double> beam;   ///< of the middle of its axis, in the same direction [m]
  std::vector<double> force;  ///< [N]
};

/// A time in which both touch without a break.
struct TouchingTime
{
  double begin, end;    ///< [s]
  double largest_force; ///< [N]
  double impulse;       ///< [N s]
};

/// @param force at steps of time, >= 0 [N]; @param time_step [s]
std::vector<TouchingTime> touching_times(const std::vector<double> &force, double time_step);

/// Largest difference of two rows of values over the largest of the second one. @param exact not zero everywhere
double largest_deviation(const std::vector<double> &values, const std::vector<double> &exact);

} // namespace bergamo::driver
