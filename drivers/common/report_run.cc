#include "drivers/common/report_run.h"

#include "drivers/common/driver_main.h"

#include <iostream>

namespace bergamo::driver
{

void report_run(const Summary &summary, const RunFolder &folder, const CommandLine &command_line,
                const std::vector<PlotJob> &pictures)
{
  Summary kept = summary;
  if (!command_line.warnings.empty()) // which were told before the run; the table has room for figures alone
    kept.set("warnings", command_line.warnings);
  kept.write(folder.summary());
  if (!command_line.quiet)
    std::cout << summary.table();
  if (!command_line.plots)
    return;
  const PlotResult plots = make_plots(pictures);
  for (const std::string &warning : plots.warnings)
    std::cerr << "warning: " << warning << '\n';
  for (const auto &picture : plots.pictures)
    std::cout << "picture: " << picture.string() << '\n';
}

int report_stop(const RunFolder &folder)
{
  std::cout << "stopped; go on with --restart --output " << folder.path().string() << '\n';
  return stopped_by_user;
}

} // namespace bergamo::driver
