#pragma once

#include "drivers/common/run/state_visitor.h"
#include "drivers/common/summary.h"
#include "drivers/silo_discharge/figures.h"
#include "drivers/silo_discharge/parameters.h"

#include <filesystem>
#include <vector>

namespace bergamo::driver
{

/// discharges.csv, a row each. Throws RunError as write_csv() does.
void write_discharges(const std::filesystem::path &path, std::vector<DischargeFigures> discharges);

/// What a restart needs of them.
void visit_done(StateVisitor &visit, std::vector<DischargeFigures> &done);

/// The figures of the run, with those of its filling and its discharges: flows over the orifices' widths beside
/// Beverloo's law with usual constants, and with those that fit three flows and more.
void add_discharges(Summary &summary, RunFigures run, FillingFigures filling,
                    const std::vector<DischargeFigures> &discharges, const SiloParameters &parameters);

} // namespace bergamo::driver
