#pragma once

#include <string>
#include <string_view>

namespace bergamo
{

/// Text as it may stand in the value of an XML attribute.
inline std::string xml_escaped(const std::string_view text)
{
  std::string escaped;
  for (const char letter : text)
    switch (letter)
    {
    case '&':
      escaped += "&amp;";
      break;
    case '<':
      escaped += "&lt;";
      break;
    case '>':
      escaped += "&gt;";
      break;
    case '"':
      escaped += "&quot;";
      break;
    default:
      escaped += letter;
    }
  return escaped;
}

} // namespace bergamo
