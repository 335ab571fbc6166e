#pragma once

#include "drivers/common/command_line.h"
#include "drivers/common/plots.h"
#include "drivers/common/run_folder.h"
#include "drivers/common/summary.h"

#include <vector>

namespace bergamo::driver
{

/// The end of a run: writes summary.json, warnings of the parameters included, shows its table, draws the pictures and
/// names them, as the command line asks. Pictures that cannot be drawn are warnings. @throws RunError when the summary
/// cannot be written
void report_run(const Summary &summary, const RunFolder &folder, const CommandLine &command_line,
                const std::vector<PlotJob> &pictures);

/// Tells how to go on with a run that the user stopped. @return stopped_by_user
int report_stop(const RunFolder &folder);

} // namespace bergamo::driver
