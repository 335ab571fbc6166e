#pragma once

#include <cstdint>
#include <string>

namespace bergamo::driver
{

/// A time in seconds and the parameter that sets it, "Loading/shear time".
struct NamedTime
{
  std::string name;
  double seconds = 0;
};

/// The number of steps that a duration takes, the last one begun counts; at least 1.
/// @throws ConfigError naming both where there are more than a run can count, 1e15: beyond, step numbers times the step
/// would no longer be told apart as doubles
std::int64_t steps_over(const NamedTime &duration, const NamedTime &step);

/// A number of steps as a whole one, from 1 to the most that a run can count. @param steps not NaN
std::int64_t whole_steps(double steps);

} // namespace bergamo::driver
