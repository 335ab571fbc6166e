#pragma once

#include "drivers/python/engine/model.h"

#include <pybind11/pybind11.h>

#include <cstdint>
#include <functional>
#include <vector>

namespace bergamo::python
{

/// Called whenever the number of the simulation's steps is a multiple of `every`, between two steps.
struct Callback
{
  std::int64_t every;
  pybind11::function call;
};

/// From pairs (every, function). Throws ConfigError for a number below 1.
std::vector<Callback> callbacks_of(const pybind11::list &pairs);

/// How a block of steps is made, and when it is done. Called without Python's lock.
struct Course
{
  std::function<bool()> is_done;
  std::function<void()> step;
  std::function<void()> prepare = [] {}; ///< before each step; its errors leave the simulation whole
};

/// Steps until the course is done, a callback stops it, or an error or a signal (Ctrl-C) comes: its exception then
/// leaves from between two steps, and the simulation may go on. Only after a RunError out of the middle of a step it
/// may not. Python's lock is left to others while steps are made.
/// @return steps made. Throws Busy out of a callback, RunError for a simulation that has failed before
std::int64_t advance(Model &model, const Course &course, const std::vector<Callback> &callbacks);

} // namespace bergamo::python
