#include "drivers/common/parameter_help.h"

#include "dem/core/error.h"
#include "drivers/common/nearest_name.h"
#include "drivers/common/number_text.h"

#include <algorithm>
#include <functional>
#include <sstream>

namespace bergamo::driver
{

namespace
{

constexpr std::size_t width = 80; // of the text, where words are no longer

/// The text in lines that begin with `indent` blanks.
std::string wrapped(const std::string &text, const std::size_t indent)
{
  std::istringstream words(text);
  std::string result, line;
  const auto end_line = [&]
  {
    result += std::string(indent, ' ') + line + "\n";
    line.clear();
  };
  for (std::string word; words >> word; line += (line.empty() ? "" : " ") + word)
    if (!line.empty() && indent + line.size() + 1 + word.size() > width)
      end_line();
  if (!line.empty())
    end_line();
  return result;
}

std::string row(const std::string &name, const std::string &text)
{
  constexpr std::size_t indent = 13;
  const std::string begin = "  " + name;
  return begin + wrapped(text, indent).substr(begin.size());
}

std::string with_unit(const std::string &text, const std::string &unit)
{
  return text.empty() ? "(empty)" : text + (unit.empty() ? "" : " " + unit);
}

std::string explanation(const ParameterEntry &parameter)
{
  const std::string unit = parameter.unit(), usual = parameter.binding.range.usual_text();
  std::string text = parameter.path + "\n" + wrapped(parameter.meaning(), 2);
  if (!unit.empty())
    text += row("unit", unit);
  text += row("allowed", parameter.binding.allowed);
  if (!usual.empty())
    text += row("usual", with_unit(usual, unit));
  text += row("default", with_unit(parameter.default_text, unit));
  if (!parameter.place.empty())
    text += row("in force", with_unit(parameter.binding.text(), unit) + ", set by " + parameter.place);
  return text;
}

/// "Grains/friction" of " Grains / friction ".
std::string without_blanks(const std::string &topic)
{
  std::istringstream stream(topic);
  std::string path;
  for (std::string part; std::getline(stream, part, '/');)
    if (!trimmed(part).empty())
      path += (path.empty() ? "" : "/") + std::string(trimmed(part));
  return path;
}

[[noreturn]] void refuse(const std::span<const ParameterEntry> parameters, const std::string &topic)
{
  std::vector<std::string> known, near;
  for (const ParameterEntry &parameter : parameters)
  {
    known.push_back(parameter.path);
    std::string above;
    for (const std::string &part : parameter.section)
    {
      above += (above.empty() ? "" : "/") + part;
      if (std::find(known.begin(), known.end(), above) == known.end())
        known.push_back(above);
    }
    if (parameter.name == topic.substr(topic.rfind('/') + 1)) // right name, wrong section
      near.push_back(parameter.path);
  }
  for (const std::string &name : nearest_names(topic, known))
    if (std::find(near.begin(), near.end(), name) == near.end())
      near.push_back(name);
  if (topic.find('/') == std::string::npos) // a name alone
    for (const ParameterEntry &parameter : parameters)
      if (near.size() < 3 && !nearest_name(topic, {&parameter.name, 1}).empty())
        near.push_back(parameter.path);
  throw ConfigError("--help " + topic + ": there is no such section or parameter" +
                    (near.empty() ? "; --print-parameters lists all" : "; did you mean " + either_of(near) + "?"));
}

} // namespace

std::string explained(const std::span<const ParameterEntry> parameters, const std::string &topic)
{
  const std::string path = without_blanks(topic);
  const auto all_with = [&](const std::function<bool(const ParameterEntry &)> &is_meant)
  {
    std::string text;
    for (const ParameterEntry &parameter : parameters)
      if (is_meant(parameter))
        text += (text.empty() ? "" : "\n") + explanation(parameter);
    return text;
  };
  std::string text = all_with([&](const ParameterEntry &p) { return p.path == path; });
  if (text.empty())
    text = all_with([&](const ParameterEntry &p) { return p.path.starts_with(path + "/"); });
  if (text.empty())
    text = all_with([&](const ParameterEntry &p) { return p.name == path; });
  if (text.empty())
    refuse(parameters, path);
  return text;
}

} // namespace bergamo::driver
