#pragma once

#include <stdexcept>

namespace bergamo::dem
{

/// The user's mistake: the message names the thing, its value, what is allowed and the remedy. Thrown before work starts.
class ConfigError : public std::invalid_argument
{
public:
  using std::invalid_argument::invalid_argument;
};

/// A run that cannot go on (diverged, disk full, damaged file); the message names what, where and the remedy.
class RunError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

} // namespace bergamo::dem
