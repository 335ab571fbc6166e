#include "drivers/common/nearest_name.h"

#include <algorithm>
#include <cctype>
#include <utility>

namespace bergamo::driver
{

namespace
{

bool same_letter(const char a, const char b)
{
  return std::tolower(static_cast<unsigned char>(a)) == std::tolower(static_cast<unsigned char>(b));
}

} // namespace

int name_distance(const std::string_view one, const std::string_view other)
{
  const std::size_t n_rows = one.size() + 1, n_columns = other.size() + 1;
  std::vector<int> distance(n_rows * n_columns);
  const auto at = [&](const std::size_t i, const std::size_t j) -> int & { return distance[i * n_columns + j]; };
  for (std::size_t i = 0; i < n_rows; ++i)
    at(i, 0) = static_cast<int>(i);
  for (std::size_t j = 0; j < n_columns; ++j)
    at(0, j) = static_cast<int>(j);
  for (std::size_t i = 1; i < n_rows; ++i)
    for (std::size_t j = 1; j < n_columns; ++j)
    {
      const int exchanged = at(i - 1, j - 1) + (same_letter(one[i - 1], other[j - 1]) ? 0 : 1);
      at(i, j) = std::min({at(i - 1, j) + 1, at(i, j - 1) + 1, exchanged});
      const bool swapped =
          i > 1 && j > 1 && same_letter(one[i - 1], other[j - 2]) && same_letter(one[i - 2], other[j - 1]);
      if (swapped)
        at(i, j) = std::min(at(i, j), at(i - 2, j - 2) + 1);
    }
  return at(one.size(), other.size());
}

std::string nearest_name(const std::string_view wrong, const std::span<const std::string> known)
{
  const std::vector<std::string> nearest = nearest_names(wrong, known);
  return nearest.empty() ? "" : nearest.front();
}

std::vector<std::string> nearest_names(const std::string_view wrong, const std::span<const std::string> known)
{
  constexpr std::size_t most = 3;
  const int allowed = std::max(2, static_cast<int>(wrong.size()) / 3);
  std::vector<std::pair<int, std::string>> near;
  for (const std::string &name : known)
    if (const int distance = name_distance(wrong, name);
        distance <= allowed && distance < static_cast<int>(name.size()))
      near.emplace_back(distance, name);
  std::stable_sort(near.begin(), near.end(), [](const auto &a, const auto &b) { return a.first < b.first; });
  std::vector<std::string> names;
  for (std::size_t k = 0; k < std::min(most, near.size()); ++k)
    names.push_back(near[k].second);
  return names;
}

std::string either_of(const std::span<const std::string> names)
{
  std::string text;
  for (std::size_t k = 0; k < names.size(); ++k)
    text += (k == 0 ? "'" : k + 1 == names.size() ? " or '" : ", '") + names[k] + "'";
  return text;
}

std::string did_you_mean(const std::string_view wrong, const std::span<const std::string> known)
{
  const std::string nearest = nearest_name(wrong, known);
  return nearest.empty() ? "" : "; did you mean '" + nearest + "'?";
}

} // namespace bergamo::driver
