#pragma once

#include <stdexcept>

namespace bergamo::fe
{

/// The user's mistake: the message names the thing, its value, what is allowed and the remedy. Thrown before work
/// starts.
class ParameterError : public std::invalid_argument
{
public:
  using std::invalid_argument::invalid_argument;
};

/// An analysis that cannot go on (damaged mesh, disk full); the message names what, where and the remedy.
class AnalysisError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

} // namespace bergamo::fe
