#pragma once

#include <string>
#include <vector>

namespace bergamo::driver
{

/// One "subsection" or "set" of a parameter file.
struct ParameterStatement
{
  enum class Kind
  {
    section,
    value
  };
  Kind kind;
  std::string path;  ///< "Section" or "Section/Name"
  std::string value; ///< of a "set"
  int line;          ///< counted from 1
};

/// The text without a byte order mark and with '\n' at the ends of lines.
std::string plain_parameter_text(const std::string &text);

/// The statements of a parameter file in order, with the lines that they begin in. Throws ConfigError, naming `source`,
/// the line and the remedy, for a line that is no statement and for sections that do not match their "end".
std::vector<ParameterStatement> scan_parameters(const std::string &text, const std::string &source);

} // namespace bergamo::driver
