#include "benchmarks/peers/liggghts_contestant.h"

#include "benchmarks/liggghts_text.h"
#include "benchmarks/peers/peer_files.h"
#include "dem/core/whole_file.h"

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <sstream>
#include <utility>

namespace bergamo::benchmark
{
namespace
{

/// Numbers from 1 on for its types of atoms and for its atoms.
constexpr int first = 1;

std::ostringstream exact_text()
{
  std::ostringstream text;
  text.precision(std::numeric_limits<double>::max_digits10);
  return text;
}

std::string data_text(const BulkCase &bulk)
{
  const dem::Particles &beads = bulk.beads;
  auto [low, high] = reach_of(bulk);
  const double margin = 0.1 * (high - low).maxCoeff(); // neither beads nor triangles may be lost
  const bool has_outlet = std::isfinite(bulk.outlet);
  low -= Vec3(margin, margin, has_outlet ? 0. : margin);
  high += Vec3::Constant(margin);
  std::ostringstream text = exact_text();
  const auto write = [&](const Vec3 &x) { text << ' ' << x.x() << ' ' << x.y() << ' ' << x.z(); };
  text << bulk.name << "\n\n" << beads.size() << " atoms\n" << bulk.parameters.materials.size() << " atom types\n\n";
  for (int d = 0; d < 3; ++d)
    text << low[d] << ' ' << high[d] << ' ' << "xyz"[d] << "lo "
         << "xyz"[d] << "hi\n";
  text << "\nAtoms\n\n"; // id, type, diameter, density, place
  for (std::size_t i = 0; i < beads.size(); ++i)
  {
    const std::int32_t material = beads.parts.material[i];
    text << beads.id[i] + first << ' ' << material + first << ' ' << 2. * beads.bounding_radius[i] << ' '
         << bulk.parameters.materials[material].density;
    write(beads.position[i]);
    text << '\n';
  }
  text << "\nVelocities\n\n"; // id, velocity, angular velocity
  for (std::size_t i = 0; i < beads.size(); ++i)
  {
    text << beads.id[i] + first;
    write(beads.velocity[i]);
    write(spin_of(beads, i));
    text << '\n';
  }
  return text.str();
}

std::string property_of_pairs(const std::string &name, const dem::MaterialTable &materials,
                              const std::function<double(const dem::SurfacePair &)> &value)
{
  std::vector<double> values;
  for (std::int32_t i = 0; i < materials.size(); ++i)
    for (std::int32_t j = 0; j < materials.size(); ++j)
      values.push_back(value(materials.between(i, j)));
  return liggghts_property(name, "peratomtypepair " + std::to_string(materials.size()), values);
}

std::string materials_text(const dem::MaterialTable &materials)
{
  std::vector<double> moduli, ratios;
  for (std::int32_t i = 0; i < materials.size(); ++i)
  {
    moduli.push_back(materials[i].young_modulus);
    ratios.push_back(materials[i].poisson_ratio);
  }
  return liggghts_property("youngsModulus", "peratomtype", moduli) +
         liggghts_property("poissonsRatio", "peratomtype", ratios) +
         property_of_pairs("coefficientRestitution", materials,
                           [](const dem::SurfacePair &pair) { return unbounded_restitution(pair.damping_ratio); }) +
         property_of_pairs("coefficientFriction", materials,
                           [](const dem::SurfacePair &pair) { return pair.friction; });
}

std::string script(const BulkCase &bulk, const double distance)
{
  const std::string model = "model hertz tangential history ";
  const std::string settings = "limitForce on tangential_damping off\n";
  const Vec3 gravity = bulk.parameters.gravity;
  std::ostringstream text = exact_text();
  text << liggghts_begin("beads.data", distance * mean_radius(bulk)) << materials_text(bulk.parameters.materials)
       << "pair_style gran " << model << settings << "pair_coeff * *\n"
       << "timestep " << bulk.parameters.time_step << "\nfix weight all gravity " << gravity.norm() << " vector "
       << gravity.x() << ' ' << gravity.y() << ' ' << gravity.z() << "\nfix motion all nve/sphere\n"
       << "fix vessel all mesh/surface file vessel.stl type " << bulk.vessel.material + first
       << "\nfix wall all wall/gran " << model << "mesh n_meshes 1 meshes vessel " << settings;
  if (bulk.vessel_spin != 0.)
    text << "fix turning all move/mesh mesh vessel rotate origin 0. 0. 0. axis 0. "
         << std::copysign(1., bulk.vessel_spin) << " 0. period " << 2. * std::numbers::pi / std::abs(bulk.vessel_spin)
         << '\n';
  text << "thermo_style custom step atoms ke\n"
          "thermo 1000000000\n"
          "thermo_modify lost ignore norm no\n"; // beads leave through the lower face of the domain
  return text.str();
}

} // namespace

LiggghtsContestant::LiggghtsContestant(std::filesystem::path program)
    : program(std::move(program)), folder("bergamo_liggghts")
{
}

std::string LiggghtsContestant::execute(const BulkCase &bulk, const double distance, const std::string &commands) const
{
  write_whole_file(folder.path() / "beads.data", data_text(bulk));
  write_whole_file(folder.path() / "vessel.stl", stl_text(bulk.vessel));
  write_whole_file(folder.path() / "in.case", script(bulk, distance) + commands);
  return output_of(program, "-log none -in in.case", folder.path());
}

Track LiggghtsContestant::run(const BulkCase &bulk, const double distance)
{
  std::ostringstream commands;
  if (bulk.only_bead != BulkCase::all)
    commands << "group watched id " << bulk.only_bead + first << '\n';
  commands << "dump track " << (bulk.only_bead == BulkCase::all ? "all" : "watched") << " custom "
           << bulk.steps_between_samples << " track.txt id x y z\nrun " << bulk.n_steps() << '\n';
  execute(bulk, distance, commands.str());
  return read_track(folder.path() / "track.txt", bulk.parameters.time_step, first);
}

double LiggghtsContestant::time(const BulkCase &bulk, const int n_steps, const double distance)
{
  const std::string output =
      execute(bulk, distance, "run " + std::to_string(warm_up_steps) + "\nrun " + std::to_string(n_steps) + '\n');
  const std::string key = "Loop time of ";
  return number_after(part_after(output, key, 1), key);
}

} // namespace bergamo::benchmark
