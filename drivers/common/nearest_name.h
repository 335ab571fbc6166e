#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace bergamo::driver
{

/// Number of single-letter insertions, deletions, exchanges and swaps of neighbours that turn one name into the other
/// (optimal string alignment distance); letters are compared without their case.
int name_distance(std::string_view one, std::string_view other);

/// The known name that the user most likely meant by `wrong`, or an empty string when none is near enough
/// (at most a third of its letters wrong, and never less than two allowed). The first one wins a tie.
std::string nearest_name(std::string_view wrong, std::span<const std::string> known);

/// Those of the known names that are near enough, the nearest first, three at most.
std::vector<std::string> nearest_names(std::string_view wrong, std::span<const std::string> known);

/// "'a', 'b' or 'c'".
std::string either_of(std::span<const std::string> names);

/// "; did you mean 'x'?" for the nearest known name, or an empty string.
std::string did_you_mean(std::string_view wrong, std::span<const std::string> known);

} // namespace bergamo::driver
