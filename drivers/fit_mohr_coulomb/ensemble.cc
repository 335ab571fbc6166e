#include "drivers/fit_mohr_coulomb/ensemble.h"

#include "dem/core/error.h"
#include "drivers/common/csv_table.h"
#include "drivers/common/number_text.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>

namespace bergamo::driver
{

namespace
{

constexpr double pressure_tolerance = 0.05; // of the mean lateral pressure during the shear
constexpr double start_tolerance = 1e-4;    // axial strain of the shear's first row

std::string name_of(const int number)
{
  char text[16];
  std::snprintf(text, sizeof text, "%04d", number);
  return text;
}

std::string list_text(const std::set<double> &values)
{
  std::string text;
  for (const double value : values)
    text += (text.empty() ? "" : ", ") + short_text(value);
  return text;
}

/// The last two stages: reads both curves of a sample.
void read_history(const std::filesystem::path &path, Sample &sample)
{
  const CsvTable table = read_csv(path, {"time_s", "stage", "strain_x", "strain_y", "strain_z", "volumetric_strain",
                                         "stress_xx_Pa", "stress_yy_Pa", "stress_zz_Pa", "solid_fraction"});
  TriaxialCurve &curve = sample.curve;
  if (table.n_rows == 0)
    throw ConfigError("'" + path.string() + "' has no rows; the sample was not sheared");
  const std::vector<double> &stage = table["stage"];
  const double shear = *std::max_element(stage.begin(), stage.end());
  for (std::size_t i = 0; i < table.n_rows; ++i)
    if (stage[i] == shear)
    {
      curve.axial_strain.push_back(table["strain_z"][i]);
      curve.volumetric_strain.push_back(table["volumetric_strain"][i]);
      curve.axial_stress.push_back(table["stress_zz_Pa"][i]);
      curve.lateral_stress.push_back(0.5 * (table["stress_xx_Pa"][i] + table["stress_yy_Pa"][i]));
      curve.solid_fraction.push_back(table["solid_fraction"][i]);
    }
    else if (stage[i] == shear - 1)
    {
      sample.compression.pressure.push_back(
          -(table["stress_xx_Pa"][i] + table["stress_yy_Pa"][i] + table["stress_zz_Pa"][i]) / 3);
      sample.compression.solid_fraction.push_back(table["solid_fraction"][i]);
    }
  if (std::abs(curve.axial_strain.front()) > start_tolerance)
    throw ConfigError("'" + path.string() + "': strain_z is " + short_text(curve.axial_strain.front()) +
                      " in the first row of stage " + short_text(shear) +
                      "; strains must count from the end of the isotropic compression, and the last stage must be "
                      "the shear");
}

/// A warning where the lateral pressure strays, or nothing.
std::string pressure_warning(const Sample &sample)
{
  double mean = 0;
  for (const double stress : sample.curve.lateral_stress)
    mean -= stress / static_cast<double>(sample.curve.size());
  if (std::abs(mean - sample.confining_pressure) <= pressure_tolerance * sample.confining_pressure)
    return "";
  return "sample " + name_of(sample.number) + ": the mean lateral pressure during the shear is " + short_text(mean) +
         " Pa, not the confining " + short_text(sample.confining_pressure) + " Pa";
}

/// The number of a sample and its pressure, checked.
void check_row(const double number, const double pressure, const std::string &place)
{
  if (!(number >= 0 && number <= 1e9 && number == std::floor(number)))
    throw ConfigError(place + ": sample is " + short_text(number) + "; it must be a whole number >= 0");
  if (!(pressure > 0))
    throw ConfigError(place + ": confining_pressure_Pa is " + short_text(pressure) + "; it must be positive");
}

/// What is mixed in the ensemble although one continuum cannot stand for it.
void warn_of_mixture(Ensemble &ensemble)
{
  std::set<double> edges, frictions;
  for (const Sample &sample : ensemble.samples)
  {
    edges.insert(sample.edge);
    frictions.insert(sample.generation_friction);
  }
  if (frictions.size() > 1)
    ensemble.warnings.push_back("packings of different density are fitted together (generation_friction " +
                                list_text(frictions) + "); choose with Ensemble/generation frictions");
  if (edges.size() > 1)
    ensemble.warnings.push_back("cells of different size are fitted together (edge_m " + list_text(edges) +
                                "); choose with Ensemble/edges");
}

} // namespace

void require_apart(const std::filesystem::path &output, const std::filesystem::path &ensemble)
{
  namespace fs = std::filesystem;
  const auto lies_within = [](const fs::path &path, const fs::path &folder)
  {
    const fs::path inner = fs::weakly_canonical(path), outer = fs::weakly_canonical(folder);
    const auto [in, out] = std::mismatch(inner.begin(), inner.end(), outer.begin(), outer.end());
    return out == outer.end();
  };
  const bool is_same = lies_within(output, ensemble) && lies_within(ensemble, output);
  if (is_same || lies_within(output, ensemble / "samples") || lies_within(ensemble, output / "previous_run"))
    throw ConfigError("output folder '" + output.string() + "' would take over the ensemble '" + ensemble.string() +
                      "' (Ensemble/folder) that the fit reads; choose another folder with --output");
}

Ensemble read_ensemble(const std::filesystem::path &folder, const SampleChoice &choice)
{
  const std::filesystem::path list = folder / "ensemble.csv";
  if (!std::filesystem::is_directory(folder))
    throw ConfigError("Ensemble/folder is '" + folder.string() +
                      "': there is no such folder; name the run folder of rve_triaxial");
  const CsvTable table =
      read_csv(list, {"sample", "edge_m", "generation_friction", "confining_pressure_Pa", "n_particles", "finished"});

  Ensemble ensemble;
  std::set<int> numbers;
  std::size_t n_unfinished = 0, n_other = 0;
  for (std::size_t i = 0; i < table.n_rows; ++i)
  {
    const std::string place = std::string("'") + list.string() + "' row " + std::to_string(i + 1);
    check_row(table["sample"][i], table["confining_pressure_Pa"][i], place);
    Sample sample{static_cast<int>(table["sample"][i]),
                  table["edge_m"][i],
                  table["generation_friction"][i],
                  table["confining_pressure_Pa"][i],
                  table["n_particles"][i],
                  {},
                  {}};
    if (!numbers.insert(sample.number).second)
      throw ConfigError(place + ": sample " + std::to_string(sample.number) + " stands there twice; remove one");
    if (table["finished"][i] != 1)
    {
      ensemble.warnings.push_back("sample " + name_of(sample.number) + " is left out: it is not finished");
      ++n_unfinished;
      continue;
    }
    if (!takes(choice.edges, sample.edge) || !takes(choice.generation_frictions, sample.generation_friction) ||
        !takes(choice.pressures, sample.confining_pressure))
    {
      ++n_other;
      continue;
    }
    read_history(folder / "samples" / name_of(sample.number) / "history.csv", sample);
    if (const std::string warning = pressure_warning(sample); !warning.empty())
      ensemble.warnings.push_back(warning);
    ensemble.samples.push_back(std::move(sample));
  }
  if (ensemble.samples.empty())
    throw ConfigError("'" + list.string() + "' leaves no sample to fit: " + std::to_string(table.n_rows) + " rows, " +
                      std::to_string(n_unfinished) + " not finished, " + std::to_string(n_other) +
                      " not chosen by edges, generation frictions and pressures; finish the ensemble, or choose more");
  warn_of_mixture(ensemble);
  return ensemble;
}

} // namespace bergamo::driver
