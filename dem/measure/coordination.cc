#include "dem/measure/coordination.h"

#include "dem/core/rows.h"

#include <cmath>

namespace bergamo::dem
{
namespace
{

/// Contacts of every grain, with grains and walls.
std::vector<std::int32_t> count_contacts(const std::size_t n_grains, const std::span<const TouchingContact> pairs,
                                         const std::span<const TouchingContact> walls)
{
  std::vector<std::int32_t> count(n_grains, 0);
  for (const TouchingContact &contact : pairs)
  {
    ++count[contact.first];
    ++count[contact.second];
  }
  for (const TouchingContact &contact : walls)
    ++count[contact.first];
  return count;
}

/// Grains that touch each grain.
Rows<std::int32_t> neighbours_of_grains(const std::size_t n_grains, const std::span<const TouchingContact> pairs)
{
  return {n_grains, [&](const auto &put)
          {
            for (const TouchingContact &contact : pairs)
            {
              put(contact.first, contact.second);
              put(contact.second, contact.first);
            }
          }};
}

/// Sum over some grains and their number.
struct Mean
{
  std::int64_t sum = 0, sum_of_squares = 0, n = 0;

  void add(const std::int64_t value)
  {
    sum += value;
    sum_of_squares += value * value;
    ++n;
  }
  double value() const { return n > 0 ? static_cast<double>(sum) / static_cast<double>(n) : 0.; }
  double deviation() const ///< without loss: the difference is one of whole numbers
  {
    return n > 0 ? std::sqrt(static_cast<double>(n * sum_of_squares - sum * sum)) / static_cast<double>(n) : 0.;
  }
};

} // namespace

std::vector<bool> find_rattlers(const Particles &particles, const std::span<const TouchingContact> pairs,
                                const std::span<const TouchingContact> walls, const std::int32_t fewest)
{
  const std::size_t n = particles.size();
  std::vector<std::int32_t> count = count_contacts(n, pairs, walls);
  const Rows<std::int32_t> neighbours = neighbours_of_grains(n, pairs);
  std::vector<bool> is_rattler(n, false);
  std::vector<std::int32_t> removed;
  const auto remove_if_loose = [&](const std::int32_t i)
  {
    if (is_rattler[i] || particles.is_fixed(i) || count[i] >= fewest)
      return;
    is_rattler[i] = true;
    removed.push_back(i);
  };
  for (std::size_t i = 0; i < n; ++i)
    remove_if_loose(static_cast<std::int32_t>(i));
  while (!removed.empty())
  {
    const std::int32_t i = removed.back();
    removed.pop_back();
    for (const std::int32_t neighbour : neighbours[i])
    {
      --count[neighbour];
      remove_if_loose(neighbour);
    }
  }
  return is_rattler;
}

CoordinationNumbers coordination_numbers(const Particles &particles, const std::span<const TouchingContact> pairs,
                                         const std::span<const TouchingContact> walls)
{
  const std::vector<bool> is_rattler = find_rattlers(particles, pairs, walls);
  std::vector<TouchingContact> bearing;
  for (const TouchingContact &contact : pairs)
    if (!is_rattler[contact.first] && !is_rattler[contact.second])
      bearing.push_back(contact);
  const std::vector<std::int32_t> count = count_contacts(particles.size(), pairs, walls),
                                  bearing_count = count_contacts(particles.size(), bearing, walls);
  Mean all, mechanical, without_rattlers;
  CoordinationNumbers numbers;
  for (std::size_t i = 0; i < particles.size(); ++i)
  {
    if (particles.is_fixed(i))
      continue;
    all.add(count[i]);
    if (count[i] >= 2)
      mechanical.add(count[i]);
    if (is_rattler[i])
      ++numbers.n_rattlers;
    else
      without_rattlers.add(bearing_count[i]);
  }
  numbers.mean = all.value();
  numbers.deviation = all.deviation();
  numbers.mechanical = mechanical.value();
  numbers.without_rattlers = without_rattlers.value();
  return numbers;
}

} // namespace bergamo::dem
