#include "benchmarks/liggghts.h"

#include "dem/core/error.h"
#include "dem/loading/compression.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <numeric>
#include <sstream>
#include <sys/wait.h>
#include <unistd.h>
#include <utility>

namespace bergamo::benchmark
{
namespace
{

namespace fs = std::filesystem;

constexpr std::array skins{0.02, 0.05, 0.1, 0.2, 0.3}; // over the mean radius
constexpr int trial_steps = 300;

fs::path make_folder()
{
  std::string path = (fs::temp_directory_path() / "bergamo_liggghts_XXXXXX").string();
  if (!mkdtemp(path.data()))
    throw RunError("cannot make the folder " + path + " for LIGGGHTS; set TMPDIR to a folder you may write to");
  return path;
}

std::string quoted(const fs::path &path)
{
  std::string text = "'";
  for (const char c : path.string())
    text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

void write_text(const fs::path &path, const std::string &text)
{
  std::ofstream file(path);
  file << text;
  if (!file.flush())
    throw RunError("cannot write " + path.string() + "; free some space or set TMPDIR to another folder");
}

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

/// The number after the last `key` in a text.
double number_after(const std::string &text, const std::string &key)
{
  const auto at = text.rfind(key);
  if (at == std::string::npos)
    throw RunError("LIGGGHTS printed no '" + key +
                   "': this version is unknown here; go without it by "
                   "--no-liggghts");
  return std::strtod(text.c_str() + at + key.size(), nullptr);
}

/// The text between the `n`th key (from 0) and the next one.
std::string part(const std::string &text, const std::string &key, const int n)
{
  std::size_t begin = 0;
  for (int i = 0; i <= n && begin != std::string::npos; ++i)
    begin = text.find(key, i == 0 ? 0 : begin + key.size());
  if (begin == std::string::npos)
    throw RunError("LIGGGHTS printed no '" + key +
                   "': this version is unknown here; go without it by "
                   "--no-liggghts");
  return text.substr(begin, text.find(key, begin + key.size()) - begin);
}

std::string last_lines(const std::string &text)
{
  const std::size_t from = text.size() > 600 ? text.size() - 600 : 0;
  const auto error = text.find("ERROR");
  return text.substr(error == std::string::npos ? from : error);
}

} // namespace

std::optional<fs::path> Liggghts::find(const std::string &program)
{
  const auto is_program = [](const fs::path &path)
  {
    std::error_code ignored;
    return fs::is_regular_file(path, ignored) && access(path.c_str(), X_OK) == 0;
  };
  if (program.find('/') != std::string::npos)
    return is_program(program) ? std::optional(fs::absolute(program)) : std::nullopt;
  const char *const path = std::getenv("PATH");
  std::istringstream folders(path ? path : "/usr/bin");
  for (std::string folder; std::getline(folders, folder, ':');)
    if (is_program(fs::path(folder) / program))
      return fs::absolute(fs::path(folder) / program);
  return std::nullopt;
}

Liggghts::Liggghts(fs::path program, const dem::Simulation &packing)
    : program(std::move(program)), folder(make_folder()), parameters(packing.parameters()), walls(packing.walls)
{
  const std::vector<double> &radius = packing.particles.bounding_radius;
  mean_radius = std::accumulate(radius.begin(), radius.end(), 0.) / radius.size();
  write_text(folder / "spheres.data", data_text(packing));
}

Liggghts::~Liggghts()
{
  std::error_code ignored;
  fs::remove_all(folder, ignored);
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
  const auto property = [](const std::string &name, const std::string &kind, const std::initializer_list<double> values)
  {
    std::ostringstream line;
    line.precision(std::numeric_limits<double>::max_digits10);
    line << "fix " << name << " all property/global " << name << ' ' << kind;
    for (const double value : values)
      line << ' ' << value;
    return line.str() + '\n';
  };
  // Its dashpot knows a coefficient of restitution only, bounded from below: 0.1 damps like a ratio of about 0.5. The
  // force of a contact at rest does not depend on it, nor does the time of a step.
  constexpr double restitution = 0.1;
  const dem::Material &grain = parameters.grain(), &wall = parameters.wall();
  const double friction = parameters.between_grains().friction, wall_friction = parameters.with_walls().friction;

  std::ostringstream text;
  text.precision(std::numeric_limits<double>::max_digits10);
  text << "atom_style granular\n"
          "atom_modify map array\n"
          "boundary f f f\n"
          "newton off\n"
          "communicate single vel yes\n"
          "hard_particles yes\n" // it asks to confirm moduli above 1 GPa
          "units si\n"
          "read_data spheres.data\n"
       << "neighbor " << skin * mean_radius << " bin\n"
       << "neigh_modify delay 0\n" // its own recommendation for granular runs
       << property("youngsModulus", "peratomtype", {grain.young_modulus, wall.young_modulus})
       << property("poissonsRatio", "peratomtype", {grain.poisson_ratio, wall.poisson_ratio})
       << property("coefficientRestitution", "peratomtypepair 2", {restitution, restitution, restitution, restitution})
       << property("coefficientFriction", "peratomtypepair 2", {friction, wall_friction, wall_friction, wall_friction})
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
  write_text(folder / "in.spheres", script(n_steps, skin));
  const std::string command = "cd " + quoted(folder) +
                              " && OMP_NUM_THREADS=1 OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 " +
                              quoted(program) + " -log none -in in.spheres 2>&1 < /dev/null";
  FILE *const pipe = popen(command.c_str(), "r");
  if (!pipe)
    throw RunError("cannot start " + program.string() + "; go without it by --no-liggghts");
  std::string output;
  std::array<char, 4096> buffer;
  while (const std::size_t n = fread(buffer.data(), 1, buffer.size(), pipe))
    output.append(buffer.data(), n);
  const int status = pclose(pipe);
  if (status != 0)
    throw RunError(program.string() + " failed with status " +
                   std::to_string(WIFEXITED(status) ? WEXITSTATUS(status) : status) + ": " + last_lines(output) +
                   "\ngo without it by --no-liggghts");

  const std::string measured = part(output, "Loop time of ", 1); // 0 is the warm-up
  LiggghtsRun result;
  result.seconds = number_after(measured, "Loop time of ");
  result.n_neighbours = number_after(measured, "Total # of neighbors = ");
  result.n_builds = number_after(measured, "Neighbor list builds = ");
  result.pair_share = number_after(measured, "Pair  time (%) = ") / result.seconds;
  result.n_contacts = 0.5 * number_after(measured, " total \n"); // each grain counts its contacts
  return result;
}

} // namespace bergamo::benchmark
