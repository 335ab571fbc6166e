#include "drivers/common/parameter_entry.h"

#include "drivers/common/number_text.h"

namespace bergamo::driver
{

std::string ParameterEntry::unit() const
{
  const std::size_t begin = doc.rfind('[');
  return begin == std::string::npos || !doc.ends_with(']') ? "" : doc.substr(begin + 1, doc.size() - begin - 2);
}

std::string ParameterEntry::meaning() const
{
  return unit().empty() ? doc : std::string(trimmed(std::string_view(doc).substr(0, doc.rfind('['))));
}

} // namespace bergamo::driver
