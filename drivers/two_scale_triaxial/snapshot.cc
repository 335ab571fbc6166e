#include "drivers/two_scale_triaxial/snapshot.h"

#include "dem/core/error.h"
#include "dem/io/snapshot.h"

#include <algorithm>
#include <sstream>

namespace bergamo::driver
{
namespace
{

constexpr const char *kind = "two-scale triaxial test";

std::span<const double> as_doubles(const std::vector<Vec3> &values)
{
  return {values.empty() ? nullptr : values.front().data(), 3 * values.size()};
}

/// The first line in which two parameter files differ.
std::string first_difference(const std::string &stored, const std::string &present)
{
  std::istringstream a(stored), b(present);
  std::string line_a, line_b;
  while (std::getline(a, line_a) && std::getline(b, line_b))
    if (line_a != line_b)
      return "'" + line_a.substr(line_a.find_first_not_of(' ')) + "' there, '" +
             line_b.substr(std::min(line_b.find_first_not_of(' '), line_b.size())) + "' here";
  return "one file is longer";
}

void write_common(ArchiveWriter &archive, const Stage stage, const std::string &parameters)
{
  archive.write("stage", static_cast<std::int64_t>(stage));
  archive.write("parameters", parameters);
}

} // namespace

void write_packing(const std::filesystem::path &path, const std::string &parameters, const dem::Simulation &grains,
                   const dem::Compression &compression)
{
  ArchiveWriter archive(path, kind);
  write_common(archive, Stage::packing, parameters);
  dem::write_simulation(archive, grains);
  archive.write("compression/n_checks_passed", compression.n_checks_passed);
  archive.write("compression/unbalance", compression.unbalance);
  archive.commit();
}

void write_loading(const std::filesystem::path &path, const std::string &parameters, Specimen &specimen,
                   const LoadingState &state)
{
  ArchiveWriter archive(path, kind);
  write_common(archive, Stage::loading, parameters);
  if (const dem::Simulation *grains = specimen.model.grains())
    dem::write_simulation(archive, *grains);
  if (fe::ExplicitBody *body = specimen.model.body())
    for (const auto &[name, values] : body->state())
      archive.write("continuum/" + name, std::span<const double>(values));
  archive.write("loading/step", state.step);
  archive.write("loading/box_low", std::span<const double>(state.box.low.data(), 3));
  archive.write("loading/box_high", std::span<const double>(state.box.high.data(), 3));
  archive.write("loading/reference", as_doubles(state.reference_by_id));
  archive.write("loading/first_balance", state.first_balance);
  archive.write("loading/largest_residual", state.largest_residual);
  archive.write("loading/smallest_stable_step", state.smallest_stable_step);
  archive.write("loading/picture_times", state.picture_times);
  archive.write("loading/solid_fraction", state.solid_fraction);
  archive.write("loading/coordination_number", state.coordination_number);
  archive.write("loading/packing_steps", state.packing_steps);
  archive.commit();
}

SnapshotReader::SnapshotReader(const std::filesystem::path &path, const std::string &parameters) : archive(path, kind)
{
  const std::string stored = archive.read_text("parameters");
  if (stored != parameters)
    throw ConfigError("the snapshot " + path.string() + " belongs to other parameters (" +
                      first_difference(stored, parameters) +
                      "); restart with those of the run, or start anew in another folder");
}

std::unique_ptr<dem::Simulation> SnapshotReader::grains(const dem::SimulationParameters &parameters) const
{
  return dem::read_simulation(archive, parameters);
}

void SnapshotReader::read(dem::Compression &compression) const
{
  compression.n_checks_passed = archive.read_double("compression/n_checks_passed");
  compression.unbalance = archive.read_double("compression/unbalance");
}

LoadingState SnapshotReader::loading_state() const
{
  LoadingState state;
  state.step = archive.read_integer("loading/step");
  archive.read_into("loading/box_low", std::span<double>(state.box.low.data(), 3));
  archive.read_into("loading/box_high", std::span<double>(state.box.high.data(), 3));
  const std::vector<double> reference = archive.read_doubles("loading/reference");
  for (std::size_t i = 0; i + 2 < reference.size(); i += 3)
    state.reference_by_id.emplace_back(reference[i], reference[i + 1], reference[i + 2]);
  state.first_balance = archive.read_double("loading/first_balance");
  state.largest_residual = archive.read_double("loading/largest_residual");
  state.smallest_stable_step = archive.read_double("loading/smallest_stable_step");
  state.picture_times = archive.read_doubles("loading/picture_times");
  state.solid_fraction = archive.read_double("loading/solid_fraction");
  state.coordination_number = archive.read_double("loading/coordination_number");
  state.packing_steps = archive.read_integer("loading/packing_steps");
  return state;
}

void SnapshotReader::read_body(fe::ExplicitBody &body) const
{
  for (const auto &[name, values] : body.state())
    archive.read_into("continuum/" + name, values);
}

} // namespace bergamo::driver
