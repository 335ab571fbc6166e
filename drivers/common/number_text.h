#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace bergamo::driver
{

/// The text without blanks at its ends.
std::string_view trimmed(std::string_view text);

/// The whole text as a finite decimal number; nothing for anything else (rest behind the number, infinity, NaN,
/// a number too large or too small for a double). Does not depend on the locale.
std::optional<double> parse_number(std::string_view text);

/// The shortest text that reads back as the very same double (at most 17 significant digits); "nan", "inf", "-inf".
std::string exact_text(double number);

/// A number for people, with `n_digits` significant digits.
std::string short_text(double number, int n_digits = 6);

} // namespace bergamo::driver
