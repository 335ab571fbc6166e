#include "dem/core/whole_file.h"
#include "drivers/common/driver_main.h"
#include "drivers/common/report_run.h"
#include "drivers/common/run_folder.h"
#include "drivers/fit_mohr_coulomb/report.h"
#include "drivers/fit_mohr_coulomb/report_laws.h"

#include <chrono>
#include <iostream>
#include <optional>

namespace
{

using namespace bergamo::driver;

void warn(const std::vector<std::string> &warnings)
{
  for (const std::string &warning : warnings)
    std::cerr << "warning: " << warning << '\n';
}

int job(const CommandLine &words)
{
  const auto start = std::chrono::steady_clock::now();
  FitParameters parameters;
  ParameterFile file("Fit of Mohr-Coulomb parameters to an ensemble of triaxial tests");
  parameters.declare(file);
  if (!read_parameters(file, words))
    return done;
  parameters.validate();
  const CommandLine command_line = warned_of(file, words);
  if (command_line.dry_run)
    return tell(parameters.forecast(), command_line);
  require_apart(command_line.output, parameters.ensemble);

  RunFolder folder(command_line, {"fit_mohr_coulomb.json", "continuum.prm", "curves_grains.csv", "curves_continuum.csv",
                                  "sand.json", "sand.prm", "curves_laws.csv"});
  const Ensemble ensemble = read_ensemble(parameters.ensemble, parameters.choice);
  warn(ensemble.warnings);
  EnsembleFit fit = fit_ensemble(ensemble.samples, parameters);
  warn(fit.warnings);
  std::optional<HardeningFit> hardening;
  if (parameters.hardening_is_wanted)
  {
    hardening = fit_hardening(tests_of_laws(ensemble, parameters), fit.continuum);
    fit.continuum = hardening->continuum;
  }
  const CurveTables curves = curve_tables(ensemble, fit);
  std::optional<LawComparison> laws;
  if (parameters.sand.is_wanted)
    laws = compare_laws(ensemble, fit, parameters);

  folder.open();
  file.write_resolved(folder.parameters());
  bergamo::write_whole_file(folder.file("fit_mohr_coulomb.json"), fit_json(ensemble, fit, parameters));
  bergamo::write_whole_file(folder.file("continuum.prm"), continuum_text(fit, parameters.ensemble));
  bergamo::write_whole_file(folder.file("curves_grains.csv"), curves.grains);
  bergamo::write_whole_file(folder.file("curves_continuum.csv"), curves.continuum);

  if (laws)
  {
    bergamo::write_whole_file(folder.file("sand.json"), laws_json(*laws));
    bergamo::write_whole_file(folder.file("sand.prm"), sand_text(*laws, fit, parameters.ensemble));
    bergamo::write_whole_file(folder.file("curves_laws.csv"), law_table(*laws));
  }

  Summary summary;
  summary.set("wall_time_s", std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), "s");
  add_figures(summary, fit);
  if (hardening)
    add_figures(summary, *hardening);
  if (laws)
    add_figures(summary, *laws);
  std::vector<PlotJob> plots{{"fit_mohr_coulomb/plot.py", {folder.path().string()}},
                             {"fit_mohr_coulomb/plot_ensemble.py", {folder.path().string()}}};
  if (laws)
    plots.push_back({"fit_mohr_coulomb/plot_laws.py", {folder.path().string()}});
  report_run(summary, folder, command_line, plots);
  if (!command_line.quiet)
    std::cout << "continuum: " << folder.file("continuum.prm").string() << '\n';
  return done;
}

} // namespace

int main(int argc, char **argv)
{
  return run_driver(argc, argv,
                    {"fit_mohr_coulomb",
                     "Fits Young's modulus, Poisson's ratio, friction angle and dilation angle of a continuum to the "
                     "triaxial tests of an ensemble of packings, and writes them as a parameter file."},
                    job);
}
