#include "drivers/common/parameter_binding.h"

#include "drivers/common/nearest_name.h"
#include "drivers/common/number_text.h"

#include <algorithm>
#include <charconv>

namespace bergamo::driver
{

namespace
{

std::string number_refusal(const std::string &text, const Range &range)
{
  const auto number = parse_number(text);
  if (!number)
    return "'" + text + "' is not a finite number";
  return range.contains(*number) ? "" : "'" + text + "' is out of range";
}

/// The parts between the commas; none for an empty text.
std::vector<std::string> comma_parts(const std::string &text)
{
  std::vector<std::string> parts;
  if (trimmed(text).empty())
    return parts;
  for (std::size_t begin = 0; begin <= text.size();)
  {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    parts.emplace_back(trimmed(std::string_view(text).substr(begin, end - begin)));
    begin = end + 1;
  }
  return parts;
}

std::string numbers_refusal(const std::vector<std::string> &parts, const Range &range)
{
  for (const std::string &part : parts)
    if (const std::string refusal = number_refusal(part, range); !refusal.empty())
      return refusal;
  return "";
}

std::string numbers_text(const std::span<const double> values)
{
  std::string text;
  for (const double value : values)
    text += (text.empty() ? "" : ", ") + exact_text(value);
  return text;
}

/// Whether a text survives the way through a parameter file, where '#' begins a comment and lines are trimmed.
std::string text_refusal(const std::string &text)
{
  if (text.find_first_of("#\n\r\t") != std::string::npos)
    return "'" + text + "' holds '#', a tab or a line break";
  if (text.ends_with("\\"))
    return "'" + text + "' ends with a backslash";
  return "";
}

template <class Integer>
std::optional<Integer> whole_number(const std::string_view text)
{
  Integer number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size())
    return std::nullopt;
  return number;
}

} // namespace

ParameterBinding bind_number(double &value, const Range &range)
{
  return {.refusal = [range](const std::string &text) { return number_refusal(text, range); },
          .assign = [&value](const std::string &text) { value = *parse_number(text); },
          .text = [&value] { return exact_text(value); },
          .allowed = "a number" + range.text(),
          .range = range};
}

ParameterBinding bind_numbers(const std::span<double> values, const Range &range)
{
  const std::string count = std::to_string(values.size());
  return {.refusal =
              [range, values, count](const std::string &text)
          {
            const auto parts = comma_parts(text);
            if (parts.size() != values.size())
              return "'" + text + "' has " + std::to_string(parts.size()) + " numbers, not " + count;
            return numbers_refusal(parts, range);
          },
          .assign =
              [values](const std::string &text)
          {
            const auto parts = comma_parts(text);
            std::transform(parts.begin(), parts.end(), values.begin(),
                           [](const std::string &part) { return *parse_number(part); });
          },
          .text = [values] { return numbers_text(values); },
          .allowed = count + " numbers" + range.text() + ", separated by commas",
          .range = range};
}

ParameterBinding bind_number_list(std::vector<double> &values, const Range &range)
{
  return {.refusal = [range](const std::string &text) { return numbers_refusal(comma_parts(text), range); },
          .assign =
              [&values](const std::string &text)
          {
            values.clear();
            for (const std::string &part : comma_parts(text))
              values.push_back(*parse_number(part));
          },
          .text = [&values] { return numbers_text(values); },
          .allowed = "numbers" + range.text() + ", separated by commas",
          .range = range};
}

ParameterBinding bind_truth(bool &value)
{
  const auto is_true = [](const std::string &text) { return text == "true" || text == "yes"; };
  return {
      .refusal = [is_true](const std::string &text)
      { return is_true(text) || text == "false" || text == "no" ? "" : "'" + text + "' is neither true nor false"; },
      .assign = [&value, is_true](const std::string &text) { value = is_true(text); },
      .text = [&value] { return value ? "true" : "false"; },
      .allowed = "true or false"};
}

ParameterBinding bind_text(std::string &value)
{
  return {.refusal = text_refusal,
          .assign = [&value](const std::string &text) { value = trimmed(text); },
          .text = [&value] { return value; },
          .allowed = "one line of text without '#'"};
}

ParameterBinding bind_choice(std::vector<std::string> choices, std::function<void(std::size_t)> set,
                             std::function<std::size_t()> get)
{
  std::string allowed = "one of ";
  for (std::size_t i = 0; i < choices.size(); ++i)
    allowed += (i == 0 ? "" : ", ") + choices[i];
  const auto find = [choices](const std::string &text)
  { return static_cast<std::size_t>(std::find(choices.begin(), choices.end(), text) - choices.begin()); };
  return {.refusal = [choices, find](const std::string &text)
          { return find(text) < choices.size() ? "" : "'" + text + "' is unknown" + did_you_mean(text, choices); },
          .assign = [set, find](const std::string &text) { set(find(text)); },
          .text = [choices, get] { return choices.at(get()); },
          .allowed = allowed};
}

std::string integer_refusal(const std::string &text, const Range &range, const std::int64_t lowest,
                            const std::uint64_t highest)
{
  const auto number = whole_number<std::int64_t>(text);
  const auto large_number = whole_number<std::uint64_t>(text);
  if (!number && !large_number)
    return "'" + text + "' is not a whole number";
  const bool fits = number ? *number >= lowest && (*number < 0 || static_cast<std::uint64_t>(*number) <= highest)
                           : *large_number <= highest;
  const double approximate = number ? static_cast<double>(*number) : static_cast<double>(*large_number);
  return fits && range.contains(approximate) ? "" : "'" + text + "' is out of range";
}

} // namespace bergamo::driver
