#pragma once

#include <stdexcept>

namespace bergamo::python
{

/// An array was looked at that is no longer the simulation's.
class StaleView : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/// A simulation was asked for something while another thread, or the step under way, has it.
class Busy : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/// Makes the library's errors those of bergamo.engine.errors, with the same text.
void register_errors();

} // namespace bergamo::python
