#pragma once

#include "dem/force/kinds/grain_grain.h"

#include <span>
#include <vector>

namespace bergamo::dem
{

/// Searches pairs at the present poses, in packs. @param searches of different pairs; @param[in,out] losses with the
/// weights [J]
/// @param[in,out] begun appended to
void search_contacts(std::span<ContactSearch> searches, const SearchContext<GrainGrain> &context, ContactLosses &losses,
                     std::vector<BegunContact<GrainGrain>> &begun);

} // namespace bergamo::dem
