#pragma once

#include "drivers/brachistochrone/figures.h"
#include "drivers/brachistochrone/parameters.h"
#include "drivers/common/summary.h"

#include <vector>

namespace bergamo::driver
{

/// Per curve, over the numbers of facets: travel times beside the closed form, deviations, and the orders with which
/// those fall from one number of facets to the next.
/// @param slides and their figures, side by side
void add_slides(Summary &summary, const std::vector<SlideSettings> &slides, const std::vector<SlideFigures> &figures);

} // namespace bergamo::driver
