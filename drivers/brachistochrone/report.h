#pragma once

#include "drivers/brachistochrone/figures.h"
#include "drivers/brachistochrone/parameters.h"
#include "drivers/common/run/state_visitor.h"
#include "drivers/common/summary.h"

#include <filesystem>
#include <vector>

namespace bergamo::driver
{

struct DoneSlide
{
  SlideSettings settings;
  SlideFigures figures;
};

/// slides.csv, a row each. Throws RunError as write_csv() does.
void write_slides(const std::filesystem::path &path, const std::vector<DoneSlide> &slides);

/// What a restart needs of them: how many of all there are, and their figures.
void visit_done(StateVisitor &visit, const std::vector<SlideSettings> &all, std::vector<DoneSlide> &done);

/// The figures of the run, with those of its slides, and per curve, over the numbers of facets: travel times beside the
/// closed form, deviations, and the orders with which those fall from one number of facets to the next.
void add_slides(Summary &summary, RunFigures run, const std::vector<DoneSlide> &slides);

} // namespace bergamo::driver
