#include "drivers/fit_mohr_coulomb/ensemble_fit.h"

#include "dem/core/error.h"
#include "drivers/common/number_text.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

namespace bergamo::driver
{

namespace
{

using Fits = std::vector<SampleFit>;

Statistic over(const Fits &fits, const std::function<double(const SampleFit &)> &figure)
{
  std::vector<double> values;
  for (const SampleFit &fit : fits)
    values.push_back(figure(fit));
  return statistic_of(values);
}

FitStatistics statistics_of(const Fits &fits, const double cohesion)
{
  return {.n_samples = fits.size(),
          .young_modulus = over(fits, [](const auto &fit) { return fit.elastic.young_modulus; }),
          .poisson_ratio = over(fits, [](const auto &fit) { return fit.elastic.poisson_ratio; }),
          .friction_angle =
              over(fits, [&](const auto &fit)
                   { return friction_angle(fit.peak_axial_pressure, fit.peak_lateral_pressure, cohesion); }),
          .dilation_angle = over(fits, [](const auto &fit) { return fit.dilation_angle; }),
          .dilation_rate = over(fits, [](const auto &fit) { return fit.dilation_rate; }),
          .peak_stress_ratio = over(fits, [](const auto &fit) { return fit.peak_stress_ratio(); }),
          .peak_compression = over(fits, [](const auto &fit) { return fit.peak_compression; }),
          .peak_axial_pressure = over(fits, [](const auto &fit) { return fit.peak_axial_pressure; }),
          .peak_lateral_pressure = over(fits, [](const auto &fit) { return fit.peak_lateral_pressure; }),
          .final_stress_ratio = over(fits, [](const auto &fit) { return fit.final_stress_ratio; }),
          .initial_solid_fraction = over(fits, [](const auto &fit) { return fit.initial_solid_fraction; }),
          .critical_solid_fraction = over(fits, [](const auto &fit) { return fit.critical_solid_fraction; })};
}

/// The fits of samples whose pressure a list takes.
Fits under(const std::vector<double> &pressures, const std::vector<Sample> &samples, const Fits &fits)
{
  Fits chosen;
  for (std::size_t i = 0; i < samples.size(); ++i)
    if (takes(pressures, samples[i].confining_pressure))
      chosen.push_back(fits[i]);
  return chosen;
}

WindowStudy window_study(const Fits &fits, const double window,
                         const std::function<std::optional<ElasticFit>(const SampleFit &)> &elastic_of)
{
  std::vector<double> young, poisson;
  for (const SampleFit &fit : fits)
    if (const auto elastic = elastic_of(fit))
    {
      young.push_back(elastic->young_modulus);
      poisson.push_back(elastic->poisson_ratio);
    }
  return {window, statistic_of(young), statistic_of(poisson)};
}

double chosen_cohesion(const FitParameters &parameters, const std::optional<Tangent> &tangent)
{
  if (parameters.cohesion_source == CohesionSource::given)
    return parameters.cohesion;
  const std::string remedy = "; set Strength/cohesion from = given";
  if (!tangent)
    throw ConfigError("Strength/cohesion from is 'common tangent', but the circles of these samples have none: at "
                      "least two different confining pressures are needed" +
                      remedy);
  if (tangent->cohesion < 0)
    throw ConfigError("Strength/cohesion from is 'common tangent', but that line has the negative cohesion " +
                      short_text(tangent->cohesion) + " Pa, which no material may have" + remedy);
  return tangent->cohesion;
}

/// Line of least squares through the logarithms; nothing for one pressure alone, or a modulus that is not positive.
std::optional<PowerLaw> power_law(const std::vector<Sample> &samples, const Fits &fits, const FitParameters &parameters)
{
  std::vector<double> pressures, moduli; // logarithms
  for (std::size_t i = 0; i < samples.size(); ++i)
    if (takes(parameters.young_pressures, samples[i].confining_pressure) && fits[i].elastic.young_modulus > 0)
    {
      pressures.push_back(std::log(samples[i].confining_pressure / parameters.reference_pressure));
      moduli.push_back(std::log(fits[i].elastic.young_modulus));
    }
  const auto [least, most] = std::minmax_element(pressures.begin(), pressures.end());
  if (pressures.empty() || *most - *least < 1e-6)
    return std::nullopt;
  const Line line = fit_line(pressures, moduli);
  return PowerLaw{std::exp(line.intercept), parameters.reference_pressure, line.slope};
}

/// Moves a fitted value into the material's range, with a word.
double within(const char *name, const double value, const double lowest, const double highest,
              std::vector<std::string> &warnings)
{
  const double allowed = std::clamp(value, lowest, highest);
  if (allowed != value)
    warnings.push_back(std::string(name) + " is fitted as " + short_text(value) +
                       ", which the continuum cannot have; " + short_text(allowed) + " is written for it");
  return allowed;
}

fe::MohrCoulombParameters continuum_of(const EnsembleFit &fit, const FitParameters &parameters,
                                       std::vector<std::string> &warnings)
{
  const FitStatistics &all = fit.all;
  if (!(all.young_modulus.mean > 0))
    throw ConfigError("Young's modulus is fitted as " + short_text(all.young_modulus.mean) +
                      " Pa: the axial stress does not rise over the first strains; choose another Elasticity/axial "
                      "strain");
  if (!(all.friction_angle.mean > 0))
    throw ConfigError("the friction angle is fitted as " + short_text(all.friction_angle.mean) +
                      " degrees: Strength/cohesion of " + short_text(fit.cohesion) +
                      " Pa alone is more than the samples' strength; choose less");
  fe::MohrCoulombParameters continuum;
  continuum.young_modulus = all.young_modulus.mean;
  if (parameters.stiffness_law == StiffnessLaw::power)
  {
    if (!fit.stiffness)
      throw ConfigError("Elasticity/stiffness is power, but these samples have a single confining pressure; take "
                        "samples under two or more, or set it to constant");
    continuum.young_modulus = fit.stiffness->modulus;
    continuum.reference_pressure = fit.stiffness->reference_pressure;
    continuum.stiffness_exponent = within("the stiffness exponent", fit.stiffness->exponent, 0, 1, warnings);
  }
  continuum.poisson_ratio = within("Poisson's ratio", all.poisson_ratio.mean, 0, 0.49, warnings);
  continuum.friction_angle = all.friction_angle.mean;
  continuum.dilation_angle = within("the dilation angle", all.dilation_angle.mean,
                                    0.9 * continuum.least_dilation_angle(), all.friction_angle.mean, warnings);
  continuum.cohesion = fit.cohesion;
  continuum.density = parameters.grain_density * all.initial_solid_fraction.mean;
  if (!(continuum.density > 0))
    throw ConfigError("the initial solid fraction is " + short_text(all.initial_solid_fraction.mean) +
                      "; check the column solid_fraction of the histories");
  return continuum;
}

} // namespace

EnsembleFit fit_ensemble(const std::vector<Sample> &samples, const FitParameters &parameters)
{
  EnsembleFit fit;
  std::vector<MohrCircle> circles;
  std::set<double> pressures;
  for (const Sample &sample : samples)
  {
    const std::string name = "sample " + std::to_string(sample.number);
    try
    {
      fit.samples.push_back(fit_sample(sample.curve, parameters.windows));
    }
    catch (const ConfigError &error)
    {
      throw ConfigError(name + ": " + error.what());
    }
    circles.push_back(fit.samples.back().peak_circle());
    pressures.insert(sample.confining_pressure);
    if (fit.samples.back().hardens_to_the_end)
      fit.warnings.push_back(name +
                             ": the axial pressure is largest at the end of the shear; the strength may be more");
  }
  fit.common_tangent = common_tangent(circles);
  fit.cohesion = chosen_cohesion(parameters, fit.common_tangent);

  const Fits young = under(parameters.young_pressures, samples, fit.samples);
  if (young.empty())
    throw ConfigError("Elasticity/pressures names none of the samples' confining pressures; name some, or leave it "
                      "empty for all");
  fit.all = statistics_of(fit.samples, fit.cohesion);
  fit.all.young_modulus = statistics_of(young, fit.cohesion).young_modulus;
  for (const double pressure : pressures)
    fit.pressures.push_back({pressure, statistics_of(under({pressure}, samples, fit.samples), fit.cohesion)});

  fit.stiffness = power_law(samples, fit.samples, parameters);

  const double window = parameters.windows.elastic_strain;
  fit.windows = {
      window_study(young, 0.5 * window, [](const auto &sample) { return sample.elastic_half; }),
      window_study(young, window, [](const auto &sample) { return std::optional(sample.elastic); }),
      window_study(young, 2 * window, [](const auto &sample) { return sample.elastic_double; }),
  };
  fit.continuum = continuum_of(fit, parameters, fit.warnings);
  return fit;
}

} // namespace bergamo::driver
