#include "drivers/fit_mohr_coulomb/report.h"

#include "drivers/common/continuum_parameters.h"
#include "drivers/fit_mohr_coulomb/csv_row.h"
#include "drivers/fit_mohr_coulomb/mean_curve.h"
#include "drivers/fit_mohr_coulomb/triaxial_path.h"

#include <nlohmann/json.hpp>

namespace bergamo::driver
{

namespace
{

using Json = nlohmann::ordered_json;

constexpr std::size_t n_curve_points = 401;

Json json_of(const Statistic &statistic)
{
  return {{"mean", statistic.mean}, {"deviation", statistic.deviation}};
}

Json json_of(const FitStatistics &figures)
{
  return {{"n_samples", figures.n_samples},
          {"young_modulus_Pa", json_of(figures.young_modulus)},
          {"poisson_ratio", json_of(figures.poisson_ratio)},
          {"friction_angle_deg", json_of(figures.friction_angle)},
          {"dilation_angle_deg", json_of(figures.dilation_angle)},
          {"dilation_rate", json_of(figures.dilation_rate)},
          {"peak_stress_ratio", json_of(figures.peak_stress_ratio)},
          {"peak_axial_compression", json_of(figures.peak_compression)},
          {"peak_axial_pressure_Pa", json_of(figures.peak_axial_pressure)},
          {"peak_lateral_pressure_Pa", json_of(figures.peak_lateral_pressure)},
          {"final_stress_ratio", json_of(figures.final_stress_ratio)},
          {"initial_solid_fraction", json_of(figures.initial_solid_fraction)},
          {"critical_solid_fraction", json_of(figures.critical_solid_fraction)}};
}

Json json_of(const Sample &sample, const SampleFit &fit, const double cohesion)
{
  return {{"sample", sample.number},
          {"edge_m", sample.edge},
          {"generation_friction", sample.generation_friction},
          {"n_particles", sample.n_particles},
          {"confining_pressure_Pa", sample.confining_pressure},
          {"young_modulus_Pa", fit.elastic.young_modulus},
          {"poisson_ratio", fit.elastic.poisson_ratio},
          {"friction_angle_deg", friction_angle(fit.peak_axial_pressure, fit.peak_lateral_pressure, cohesion)},
          {"dilation_angle_deg", fit.dilation_angle},
          {"dilation_rate", fit.dilation_rate},
          {"peak_stress_ratio", fit.peak_stress_ratio()},
          {"peak_axial_compression", fit.peak_compression},
          {"final_stress_ratio", fit.final_stress_ratio},
          {"initial_solid_fraction", fit.initial_solid_fraction},
          {"critical_solid_fraction", fit.critical_solid_fraction}};
}

Json json_of(const fe::MohrCoulombParameters &continuum)
{
  return {{"young_modulus_Pa", continuum.young_modulus},
          {"poisson_ratio", continuum.poisson_ratio},
          {"friction_angle_deg", continuum.friction_angle},
          {"dilation_angle_deg", continuum.dilation_angle},
          {"cohesion_Pa", continuum.cohesion},
          {"reference_pressure_Pa", continuum.reference_pressure},
          {"stiffness_exponent", continuum.stiffness_exponent},
          {"density_kg_m3", continuum.density}};
}

/// The samples' curves under one pressure.
std::vector<const TriaxialCurve *> curves_under(const double pressure, const std::vector<Sample> &samples)
{
  std::vector<const TriaxialCurve *> curves;
  for (const Sample &sample : samples)
    if (sample.confining_pressure == pressure)
      curves.push_back(&sample.curve);
  return curves;
}

} // namespace

std::string fit_json(const Ensemble &ensemble, const EnsembleFit &fit, const FitParameters &parameters)
{
  Json object = json_of(fit.all);
  object["cohesion_Pa"] = fit.cohesion;
  object["stiffness_power_law"] = nullptr;
  if (fit.stiffness)
    object["stiffness_power_law"] = {{"young_modulus_Pa", fit.stiffness->modulus},
                                     {"reference_pressure_Pa", fit.stiffness->reference_pressure},
                                     {"exponent", fit.stiffness->exponent}};
  object["common_tangent"] = nullptr;
  if (fit.common_tangent)
    object["common_tangent"] = {{"friction_angle_deg", fit.common_tangent->friction_angle},
                                {"cohesion_Pa", fit.common_tangent->cohesion}};
  object["continuum"] = json_of(fit.continuum);
  object["windows"] = {{"elastic_axial_strain", parameters.windows.elastic_strain},
                       {"dilation_from", parameters.windows.dilation_from},
                       {"dilation_to", parameters.windows.dilation_to}};
  for (const WindowStudy &study : fit.windows)
    object["elastic_windows"].push_back({{"axial_strain", study.axial_strain},
                                         {"young_modulus_Pa", json_of(study.young_modulus)},
                                         {"poisson_ratio", json_of(study.poisson_ratio)}});
  for (const PressureFit &pressure : fit.pressures)
  {
    Json entry = {{"confining_pressure_Pa", pressure.confining_pressure}};
    entry.update(json_of(pressure.statistics));
    object["pressures"].push_back(entry);
  }
  for (std::size_t i = 0; i < fit.samples.size(); ++i)
    object["samples"].push_back(json_of(ensemble.samples[i], fit.samples[i], fit.cohesion));
  object["warnings"] = ensemble.warnings;
  for (const std::string &warning : fit.warnings)
    object["warnings"].push_back(warning);
  return object.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string continuum_text(const EnsembleFit &fit, const std::string &ensemble_folder)
{
  ContinuumParameters continuum{.law = ContinuumLaw::mohr_coulomb, .mohr_coulomb = fit.continuum, .sand = {}};
  ParameterFile file("Continuum fitted by fit_mohr_coulomb to " + std::to_string(fit.all.n_samples) + " samples of " +
                     ensemble_folder);
  continuum.declare(file);
  return file.resolved_text();
}

CurveTables curve_tables(const Ensemble &ensemble, const EnsembleFit &fit)
{
  CurveTables tables;
  tables.grains = "confining_pressure_Pa,n_samples,axial_strain,axial_stress_Pa,axial_stress_deviation_Pa,stress_ratio,"
                  "stress_ratio_deviation,volumetric_strain,volumetric_strain_deviation,solid_fraction,"
                  "solid_fraction_deviation\n";
  tables.continuum = "confining_pressure_Pa,axial_strain,axial_stress_Pa,lateral_stress_Pa,stress_ratio,"
                     "volumetric_strain,solid_fraction\n";
  const fe::MohrCoulomb material(fit.continuum);
  for (const PressureFit &pressure : fit.pressures)
  {
    const double p = pressure.confining_pressure;
    const auto curves = curves_under(p, ensemble.samples);
    std::vector<double> axial_strains;
    for (const MeanPoint &point : mean_curve(curves, n_curve_points))
    {
      axial_strains.push_back(point.axial_strain);
      tables.grains += row_of({p, static_cast<double>(curves.size()), point.axial_strain, point.axial_stress.mean,
                               point.axial_stress.deviation, point.stress_ratio.mean, point.stress_ratio.deviation,
                               point.volumetric_strain.mean, point.volumetric_strain.deviation,
                               point.solid_fraction.mean, point.solid_fraction.deviation});
    }
    const TriaxialCurve path =
        drive_triaxial(material, {p, pressure.statistics.initial_solid_fraction.mean}, axial_strains);
    for (std::size_t i = 0; i < path.size(); ++i)
      tables.continuum += row_of({p, path.axial_strain[i], path.axial_stress[i], path.lateral_stress[i],
                                  path.stress_ratio(i), path.volumetric_strain[i], path.solid_fraction[i]});
  }
  return tables;
}

void add_figures(Summary &summary, const EnsembleFit &fit)
{
  const auto add =
      [&](const std::string &name, const Statistic &statistic, const std::string &suffix, const std::string &unit)
  {
    summary.set(name + suffix, statistic.mean, unit);
    summary.set(name + "_deviation" + suffix, statistic.deviation, unit);
  };
  summary.set("samples", fit.all.n_samples);
  add("young_modulus", fit.all.young_modulus, "_Pa", "Pa");
  add("poisson_ratio", fit.all.poisson_ratio, "", "");
  add("friction_angle", fit.all.friction_angle, "_deg", "°");
  add("dilation_angle", fit.all.dilation_angle, "_deg", "°");
  summary.set("cohesion_Pa", fit.cohesion, "Pa");
  add("peak_stress_ratio", fit.all.peak_stress_ratio, "", "");
  add("final_stress_ratio", fit.all.final_stress_ratio, "", "");
  add("dilation_rate", fit.all.dilation_rate, "", "");
  add("critical_solid_fraction", fit.all.critical_solid_fraction, "", "");
}

} // namespace bergamo::driver
