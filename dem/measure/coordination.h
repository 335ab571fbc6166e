#pragma once

#include "dem/force/contacts.h"
#include "dem/state/particles.h"

#include <cstdint>
#include <span>
#include <vector>

namespace bergamo::dem
{

/// Contacts per grain. Fixed grains are walls: they support others and do not count themselves. 0 where no grain
/// counts.
struct CoordinationNumbers
{
  double mean = 0.;             ///< of all grains, 2 Nc / N
  double deviation = 0.;        ///< standard deviation of the grains' numbers of contacts from it
  double mechanical = 0.;       ///< of grains with two contacts or more, (2 Nc - N1) / (N - N0 - N1) (Thornton 2000)
  double without_rattlers = 0.; ///< of the grains that are no rattlers, from the contacts among them
  std::int64_t n_rattlers = 0;  ///< see find_rattlers()
};

/// 2 Nc / N of contacts between grains, without a list of them. @param n_grains N, none of them fixed; above 0
inline double mean_coordination(const Contacts &contacts, const std::size_t n_grains)
{
  return 2. * contacts.n_touching() / static_cast<double>(n_grains);
}

/// @param pairs touching contacts between grains; @param walls with walls, see touching_walls()
CoordinationNumbers coordination_numbers(const Particles &particles, std::span<const TouchingContact> pairs,
                                         std::span<const TouchingContact> walls = {});

/// Fewest contacts that hold a sphere without friction. Two may hold a grain with friction: Thornton's number has
/// those.
inline constexpr std::int32_t fewest_contacts = 4;

/// Marks by grain those with fewer contacts than fewest, and again those that lose theirs to them, until none is left:
/// the rattlers (O'Hern et al. 2003, with d + 1 = 4).
std::vector<bool> find_rattlers(const Particles &particles, std::span<const TouchingContact> pairs,
                                std::span<const TouchingContact> walls = {}, std::int32_t fewest = fewest_contacts);

} // namespace bergamo::dem
