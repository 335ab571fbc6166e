#pragma once

#include <sstream>
#include <stdexcept>
#include <string_view>

namespace bergamo
{

/// The user's mistake: the message names the thing, its value, what is allowed and the remedy. Thrown before work
/// starts.
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

/// Throws ConfigError with the parts as << writes them, one after the other.
template <class... Parts>
[[noreturn]] void reject(const Parts &...parts)
{
  std::ostringstream message;
  (message << ... << parts);
  throw ConfigError(message.str());
}

/// Throws ConfigError "<name> is <value>: it must be <allowed>" unless the condition is met.
inline void require(const bool is_met, const std::string_view name, const double value, const std::string_view allowed)
{
  if (!is_met)
    reject(name, " is ", value, ": it must be ", allowed);
}

} // namespace bergamo
