#include "benchmarks/liggghts.h"

#include "benchmarks/liggghts_text.h"
#include "dem/core/whole_file.h"
#include "dem/loading/compression.h"

#include <array>
#include <limits>
#include <numeric>
#include <sstream>
#include <utility>

namespace bergamo::benchmark
{
namespace
{

namespace fs = std::filesystem;

constexpr std::array skins{0.02, 0.05, 0.1, 0.2, 0.3}; // over the mean radius
constexpr int trial_steps = 300;

std::string data_text(const dem::Simulation &packing)
{
  const dem::Particles &particles = packing.particles;
  dem::Box box = dem::box_between(packing.walls);
  const double margin = 0.1 * box.edges().minCoeff(); // spheres overlap the walls a little and must not be lost
  std::ostringstream text;
  text.precision(std::numeric_limits<double>::max_digits10);
  text << "spheres between six walls\n\n" << particles.size() << " atoms\n2 atom types\n\n";
  for (int d = 0; d < 3; ++d)
    text << box.low[d] - margin << ' ' << box.high[d] + margin << ' ' << "xyz"[d] << "lo "
         << "xyz"[d] << "hi\n";
  text << "\nAtoms\n\n"; // id, type, diameter, density, place
  for (std::size_t i = 0; i < particles.size(); ++i)
    text << i + 1 << " 1 " << 2. * particles.bounding_radius[i] << ' ' << packing.parameters().grain().density << ' '
         << particles.position[i].x() << ' ' << particles.position[i].y() << ' ' << particles.position[i].z() << '\n';
  return text.str();
}

} // namespace

Liggghts::Liggghts(fs::path program, const dem::Simulation &packing)
    : program(std::move(program)), folder("bergamo_liggghts"), parameters(packing.parameters()), walls(packing.walls)
{
  const std::vector<double> &radius = packing.particles.bounding_radius;
  mean_radius = std::accumulate(radius.begin(), radius.end(), 0.) / radius.size();
  write_whole_file(folder.path() / "spheres.data", data_text(packing));
}

double Liggghts::fastest_skin() const
{
  double best = skins[0], least = std::numeric_limits<double>::infinity();
  for (const double skin : skins)
    if (const double seconds = run(trial_steps, skin).seconds; seconds < least)
    {
      least = seconds;
      best = skin;
    }
  return best;
}

std::string Liggghts::script(const int n_steps, const double skin) const
{
  // Its dashpot knows a coefficient of restitution only, bounded from below: 0.1 damps like a ratio of about 0.5. The
  // force of a contact at rest does not depend on it, nor does the time of a step.
  constexpr double restitution = 0.1;
  const dem::Material &grain = parameters.grain(), &wall = parameters.wall();
  const double friction = parameters.between_grains().friction, wall_friction = parameters.with_walls().friction;

  std::ostringstream text;
  text.precision(std::numeric_limits<double>::max_digits10);
  text << liggghts_begin("spheres.data", skin * mean_radius)
       << liggghts_property("youngsModulus", "peratomtype", {grain.young_modulus, wall.young_modulus})
       << liggghts_property("poissonsRatio", "peratomtype", {grain.poisson_ratio, wall.poisson_ratio})
       << liggghts_property("coefficientRestitution", "peratomtypepair 2",
                            {restitution, restitution, restitution, restitution})
       << liggghts_property("coefficientFriction", "peratomtypepair 2",
                            {friction, wall_friction, wall_friction, wall_friction})
       << "pair_style gran model hertz tangential history\n"
          "pair_coeff * *\n"
       << "timestep " << parameters.time_step << "\nfix motion all nve/sphere\n";
  for (int w = 0; w < 6; ++w)
    text << "fix wall" << w << " all wall/gran model hertz tangential history primitive type 2 "
         << "xyz"[w / 2] << "plane " << walls[w].point[w / 2] << '\n';
  text << "compute contacts all contact/atom\n"
          "compute total all reduce sum c_contacts\n"
          "thermo_style custom step atoms ke\n"
          "thermo 1000000000\n"
       << "run " << warm_up_steps << "\nrun " << n_steps
       << "\nthermo_style custom c_total\n" // after the measured run, which it would slow down
          "run 0\n";
  return text.str();
}

LiggghtsRun Liggghts::run(const int n_steps, const double skin) const
{
  write_whole_file(folder.path() / "in.spheres", script(n_steps, skin));
  const std::string output = output_of(program, "-log none -in in.spheres", folder.path());

  const std::string measured = part_after(output, "Loop time of ", 1); // 0 is the warm-up
  LiggghtsRun result;
  result.seconds = number_after(measured, "Loop time of ");
  result.n_neighbours = number_after(measured, "Total # of neighbors = ");
  result.n_builds = number_after(measured, "Neighbor list builds = ");
  result.pair_share = number_after(measured, "Pair  time (%) = ") / result.seconds;
  result.n_contacts = 0.5 * number_after(measured, " total \n"); // each grain counts its contacts
  return result;
}

} // namespace bergamo::benchmark
