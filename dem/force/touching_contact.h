#pragma once

#include "dem/force/contact_state.h"
#include "dem/state/periodic_cell.h"

#include <cstdint>

namespace bergamo::dem
{

/// The second body of a contact with a wall.
inline constexpr std::int32_t no_grain = -1;

/// One touching contact as a reader sees it.
struct TouchingContact
{
  std::int32_t first, second; ///< particles; the second may be no_grain
  ContactState<double> state;
  Vec3 branch;             ///< centre of body 2, in its image, minus centre of body 1; walls: to the contact point [m]
  Image image = own_image; ///< of body 2, see PeriodicCell
  std::int32_t wall = -1;  ///< that is body 2, else negative
  std::int32_t law = 0;    ///< number of the pair of materials, see MaterialTable
};

} // namespace bergamo::dem
