#include "drivers/common/number_text.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>

namespace bergamo::driver
{

std::string_view trimmed(std::string_view text)
{
  constexpr std::string_view blanks = " \t\r\n";
  const auto first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos)
    return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

std::optional<double> parse_number(std::string_view text)
{
  text = trimmed(text);
  if (text.size() > 1 && text[0] == '+' && text[1] != '-')
    text.remove_prefix(1);
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(number))
    return std::nullopt;
  return number;
}

std::string exact_text(const double number)
{
  std::array<char, 32> text;
  const auto end = std::to_chars(text.data(), text.data() + text.size(), number).ptr;
  return {text.data(), end};
}

std::string short_text(const double number, const int n_digits)
{
  std::array<char, 48> text;
  std::snprintf(text.data(), text.size(), "%.*g", n_digits, number);
  return text.data();
}

} // namespace bergamo::driver
