#include "drivers/common/driver_main.h"
#include "drivers/common/interrupt.h"
#include "drivers/common/parameter_file.h"
#include "drivers/common/report_run.h"
#include "drivers/two_scale_triaxial/parameters.h"
#include "drivers/two_scale_triaxial/triaxial_run.h"

namespace
{

using namespace bergamo::driver;

/// Pictures of this run, and the comparison of the three models where the runs of the others lie beside it.
std::vector<PlotJob> plot_jobs(const std::filesystem::path &folder)
{
  std::vector<PlotJob> jobs{
      {"stresses.py", {folder.string()}}, {"energy.py", {folder.string()}}, {"picture.py", {folder.string()}}};
  std::vector<std::string> others;
  if (const auto parent = std::filesystem::absolute(folder).lexically_normal().parent_path();
      std::filesystem::is_directory(parent))
    for (const char *kind : {"two-scale", "two_scale_triaxial", "grains", "continuum"})
      if (const auto other = parent / kind;
          std::filesystem::exists(other / "summary.json") && !std::filesystem::equivalent(other, folder))
        others.push_back(other.string());
  if (!others.empty())
  {
    jobs[0].arguments.push_back("--compare");
    jobs[0].arguments.insert(jobs[0].arguments.end(), others.begin(), others.end());
  }
  return jobs;
}

int job(const CommandLine &command_line)
{
  TriaxialParameters parameters;
  ParameterFile file("Two-scale triaxial test");
  parameters.declare(file);
  if (!read_parameters(file, command_line))
    return done;
  parameters.validate();

  RunFolder folder(command_line);
  TriaxialRun run(parameters, command_line, file.resolved_text(), folder);
  if (!run.run())
    return report_stop(folder);
  report_run(run.summary(), folder, command_line, plot_jobs(folder.path()));
  return done;
}

} // namespace

int main(int argc, char **argv)
{
  return run_driver(
      argc, argv,
      {"two_scale_triaxial",
       "Triaxial test on a cube of sand: grains in the upper half, continuum in the lower half, joined in "
       "an overlap (Arlequin method). Compresses the cube isotropically and then shears it."},
      job);
}
