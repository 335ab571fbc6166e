#pragma once

#include "drivers/common/parameter_binding.h"

#include <string>
#include <vector>

namespace bergamo::driver
{

/// One parameter of a job: what is told of it, and the variable behind it.
struct ParameterEntry
{
  std::vector<std::string> section; ///< "Grains", "Shape"
  std::string name;
  std::string path; ///< "Grains/Shape/name"
  std::string doc;  ///< what it is, and its unit in brackets at the end
  std::string default_text;
  ParameterBinding binding;
  std::string place; ///< where its value was set, "sand.prm line 3"; empty: nowhere, it is the default

  /// "kg/m3" of a doc that ends with "[kg/m3]"; empty for numbers without a unit.
  std::string unit() const;

  /// The doc without the unit.
  std::string meaning() const;
};

} // namespace bergamo::driver
