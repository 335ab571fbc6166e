#include "drivers/fit_mohr_coulomb/report_laws.h"

#include "drivers/common/continuum_parameters.h"
#include "drivers/fit_mohr_coulomb/csv_row.h"

#include <nlohmann/json.hpp>

namespace bergamo::driver
{
namespace
{

constexpr std::size_t n_points = 61; // of a shear

nlohmann::ordered_json json_of(const Misfit &misfit)
{
  return {{"all", misfit.all},
          {"stress_ratio", misfit.stress_ratio},
          {"volumetric_strain", misfit.volumetric_strain},
          {"compression", misfit.compression}};
}

} // namespace

std::vector<SandTest> tests_of_laws(const Ensemble &ensemble, const FitParameters &parameters)
{
  return sand_tests(ensemble.samples, n_points, parameters.sand.compression_from);
}

LawComparison compare_laws(const Ensemble &ensemble, const EnsembleFit &fit, const FitParameters &parameters)
{
  LawComparison laws;
  laws.tests = tests_of_laws(ensemble, parameters);
  laws.sand = fit_sand(laws.tests, parameters.sand);
  laws.mohr_coulomb = curves_of(fe::MohrCoulomb(fit.continuum), laws.tests);
  laws.mohr_coulomb_misfit = misfit(laws.tests, laws.mohr_coulomb);
  return laws;
}

std::string sand_text(const LawComparison &laws, const EnsembleFit &fit, const std::string &ensemble_folder)
{
  ContinuumParameters continuum{
      .law = ContinuumLaw::hypoplastic_sand, .mohr_coulomb = fit.continuum, .sand = laws.sand.sand};
  ParameterFile file("Sand fitted by fit_mohr_coulomb to " + std::to_string(fit.all.n_samples) + " samples of " +
                     ensemble_folder);
  continuum.declare(file);
  return file.resolved_text();
}

std::string law_table(const LawComparison &laws)
{
  std::string table = "is_shear,generation_friction,confining_pressure_Pa,axial_strain,pressure_Pa,stress_ratio_grains,"
                      "stress_ratio_mohr_coulomb,stress_ratio_sand,volumetric_strain_grains,"
                      "volumetric_strain_mohr_coulomb,volumetric_strain_sand\n";
  for (std::size_t t = 0; t < laws.tests.size(); ++t)
  {
    const SandTest &test = laws.tests[t];
    const LawCurves &mohr_coulomb = laws.mohr_coulomb[t], &sand = laws.sand.curves[t];
    const auto volumetric = [](const std::vector<double> &solid_fraction, const std::size_t i)
    { return solid_fraction.front() / solid_fraction[i] - 1; };
    for (std::size_t i = 0; i < test.compression.size(); ++i)
      table +=
          row_of({0, test.generation_friction, test.confining_pressure, 0, test.compression.pressure[i], 1, 1, 1,
                  volumetric(test.compression.solid_fraction, i), volumetric(mohr_coulomb.compressed_solid_fraction, i),
                  volumetric(sand.compressed_solid_fraction, i)});
    for (std::size_t i = 0; i < test.shear.size(); ++i)
      table += row_of({1, test.generation_friction, test.confining_pressure, test.shear[i].axial_strain,
                       test.confining_pressure, test.shear[i].stress_ratio.mean, mohr_coulomb.shear.stress_ratio(i),
                       sand.shear.stress_ratio(i),
                       test.shear[i].volumetric_strain.mean - test.shear.front().volumetric_strain.mean,
                       mohr_coulomb.shear.volumetric_strain[i], sand.shear.volumetric_strain[i]});
  }
  return table;
}

std::string laws_json(const LawComparison &laws)
{
  const fe::HypoplasticParameters &p = laws.sand.sand;
  nlohmann::ordered_json object;
  object["misfit"] = {{"mohr_coulomb", json_of(laws.mohr_coulomb_misfit)}, {"sand", json_of(laws.sand.misfit)}};
  object["sand"] = {{"critical_friction_angle_deg", p.critical_friction_angle},
                    {"granulate_hardness_Pa", p.granulate_hardness},
                    {"compression_exponent", p.compression_exponent},
                    {"densest_void_ratio", p.densest_void_ratio},
                    {"critical_void_ratio", p.critical_void_ratio},
                    {"loosest_void_ratio", p.loosest_void_ratio},
                    {"pyknotropy_exponent", p.pyknotropy_exponent},
                    {"stiffness_exponent", p.stiffness_exponent}};
  object["n_tests"] = laws.tests.size();
  return object.dump(2) + "\n";
}

void add_figures(Summary &summary, const HardeningFit &fit)
{
  const fe::MohrCoulombParameters &p = fit.continuum;
  summary.set("misfit_hardening", fit.misfit.all);
  summary.set("misfit_hardening_stress_ratio", fit.misfit.stress_ratio);
  summary.set("misfit_hardening_volumetric_strain", fit.misfit.volumetric_strain);
  summary.set("hardening_young_modulus_Pa", p.young_modulus, "Pa");
  summary.set("hardening_stiffness_exponent", p.stiffness_exponent);
  summary.set("hardening_poisson_ratio", p.poisson_ratio);
  summary.set("hardening_friction_angle_deg", p.friction_angle, "°");
  summary.set("hardening_dilation_angle_deg", p.dilation_angle, "°");
  summary.set("hardening_strain", p.hardening_strain);
}

void add_figures(Summary &summary, const LawComparison &laws)
{
  const fe::HypoplasticParameters &p = laws.sand.sand;
  summary.set("misfit_mohr_coulomb", laws.mohr_coulomb_misfit.all);
  summary.set("misfit_sand", laws.sand.misfit.all);
  summary.set("sand_critical_friction_angle_deg", p.critical_friction_angle, "°");
  summary.set("sand_granulate_hardness_Pa", p.granulate_hardness, "Pa");
  summary.set("sand_compression_exponent", p.compression_exponent);
  summary.set("sand_densest_void_ratio", p.densest_void_ratio);
  summary.set("sand_critical_void_ratio", p.critical_void_ratio);
  summary.set("sand_pyknotropy_exponent", p.pyknotropy_exponent);
  summary.set("sand_stiffness_exponent", p.stiffness_exponent);
}

} // namespace bergamo::driver
