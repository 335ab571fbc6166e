#include "benchmarks/hourglass.h"

#include "dem/core/error.h"
#include "dem/io/snapshot.h"
#include "dem/packing/grading.h"
#include "dem/packing/random_addition.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <sstream>

namespace bergamo::benchmark
{
namespace
{

constexpr double pi = std::numbers::pi;
constexpr double slope = 0.57735026918962576; // tan 30 degrees: radius over height of the cones
constexpr double wall_radius = 1e-3;          // of the spheres that make up the walls [m]
constexpr double wall_spacing = 1.2e-3;       // below sqrt(3) radii no grain sees a gap [m]

/// Surface of revolution about z; the neck lies at z = 0.
struct Shape
{
  double neck_radius, chamber_radius, cylinder_height;

  double cone_height() const { return (chamber_radius - neck_radius) / slope; }
  double top() const { return cone_height() + cylinder_height; }
  double radius_at(const double z) const { return std::min(neck_radius + slope * std::abs(z), chamber_radius); }
};

/// Cone and cylinder above the neck hold about the same volume of loose grains.
Shape shape_for(const HourglassRecipe &recipe, const double grain_volume, const double solid_fraction)
{
  const double volume = recipe.n_grains * grain_volume / solid_fraction;
  const double radius = std::cbrt(0.5 * volume * 3. * slope / pi); // the neck takes a thousandth of it
  const double cone = pi / 3. * (std::pow(radius, 3) - std::pow(recipe.neck_radius, 3)) / slope;
  return {recipe.neck_radius, radius, (volume - cone) / (pi * radius * radius)};
}

/// Spheres in rings, each turned by half a spacing against the one below.
void add_walls(dem::Particles &particles, const Shape &shape, const double bottom)
{
  const dem::Superquadric sphere{Vec3::Constant(wall_radius), 1., 1.};
  int ring = 0;
  for (double z = bottom; z < shape.top(); ++ring)
  {
    const double radius = shape.radius_at(z) + wall_radius; // the sand touches the spheres' inner side
    const int n = static_cast<int>(std::ceil(2. * pi * radius / wall_spacing));
    for (int k = 0; k < n; ++k)
    {
      const double angle = 2. * pi * (k + 0.5 * (ring % 2)) / n;
      particles.add(sphere, 2650., Vec3(radius * std::cos(angle), radius * std::sin(angle), z), Quaternion::Identity());
      particles.fix(particles.size() - 1);
    }
    const bool is_cone = std::abs(z) < shape.cone_height();
    z += 0.5 * std::sqrt(3.) * wall_spacing * (is_cone ? std::cos(pi / 6.) : 1.);
  }
}

dem::SimulationParameters parameters_of(const HourglassRecipe &recipe)
{
  dem::SimulationParameters parameters;
  parameters.grain().young_modulus = parameters.wall().young_modulus = recipe.young_modulus;
  parameters.with_walls().friction = parameters.between_grains().friction;
  parameters.gravity = Vec3(0., 0., -9.81);
  parameters.set_damping(0.5);
  parameters.verlet_distance = 0.2;
  // A tenth of the period of the smallest grain on a stiff contact, which the log shows.
  parameters.time_step = 8e-6 * std::sqrt(1e7 / recipe.young_modulus);
  return parameters;
}

constexpr const char *archive_kind = "flowing hourglass";
constexpr int route = 1; // increase it with every change of flowing_hourglass()

/// Figures of the flow after one more step: they tell whether the engine still reads its own files rightly.
FlowFigures figures_after_step(const dem::Simulation &hourglass)
{
  dem::Simulation next = hourglass;
  next.step();
  return flow_figures(next);
}

std::unique_ptr<dem::Simulation> read_hourglass(const std::filesystem::path &path, const HourglassRecipe &recipe)
{
  const ArchiveReader archive(path, archive_kind);
  if (archive.read_integer("recipe/route") != route || archive.read_integer("recipe/n_grains") != recipe.n_grains ||
      archive.read_double("recipe/neck_radius") != recipe.neck_radius ||
      archive.read_double("recipe/young_modulus") != recipe.young_modulus ||
      archive.read_double("recipe/flow_time") != recipe.flow_time)
    throw RunError(path.string() + " was made in another way");
  auto hourglass = dem::read_simulation(archive, parameters_of(recipe));
  const FlowFigures figures = figures_after_step(*hourglass);
  const auto agrees = [&](const char *name, const double value)
  {
    const double stored = archive.read_double(name);
    return std::abs(value - stored) <= 0.01 * std::abs(stored);
  };
  if (!agrees("figures/coordination_number", figures.coordination_number) ||
      !agrees("figures/mean_speed", figures.mean_speed))
    throw RunError(path.string() + " does not give back the flow that was stored");
  return hourglass;
}

void write_hourglass(const std::filesystem::path &path, const HourglassRecipe &recipe, const dem::Simulation &hourglass)
{
  const FlowFigures figures = figures_after_step(hourglass);
  ArchiveWriter archive(path, archive_kind);
  archive.write("recipe/route", route);
  archive.write("recipe/n_grains", recipe.n_grains);
  archive.write("recipe/neck_radius", recipe.neck_radius);
  archive.write("recipe/young_modulus", recipe.young_modulus);
  archive.write("recipe/flow_time", recipe.flow_time);
  archive.write("figures/coordination_number", figures.coordination_number);
  archive.write("figures/mean_speed", figures.mean_speed);
  dem::write_simulation(archive, hourglass);
  archive.commit();
}

} // namespace

FlowFigures flow_figures(const dem::Simulation &simulation)
{
  const dem::Particles &p = simulation.particles;
  FlowFigures figures;
  double speed = 0.;
  int below = 0;
  for (std::size_t i = 0; i < p.size(); ++i)
  {
    if (p.is_fixed(i))
    {
      ++figures.n_wall_spheres;
      continue;
    }
    ++figures.n_grains;
    speed += p.velocity[i].norm();
    below += p.position[i][2] < 0.;
  }
  double ends = 0.;
  for (const auto &contact : simulation.contacts.touching(p))
    ends += !p.is_fixed(contact.first) + !p.is_fixed(contact.second);
  figures.coordination_number = ends / figures.n_grains;
  figures.mean_speed = speed / figures.n_grains;
  figures.share_below_neck = static_cast<double>(below) / figures.n_grains;
  return figures;
}

std::unique_ptr<dem::Simulation> flowing_hourglass(const HourglassRecipe &recipe,
                                                   const std::function<void(const std::string &)> &log)
{
  constexpr double solid_fraction = 0.25; // of the random addition
  std::mt19937_64 generator(1);
  const dem::GrainDistribution sand;
  constexpr int n_sample = 1000;
  double grain_volume = 0.;
  for (int i = 0; i < n_sample; ++i)
    grain_volume += dem::volume(dem::draw_grain(sand, generator)) / n_sample;
  const Shape shape = shape_for(recipe, grain_volume, solid_fraction);

  // Grains in the box around the upper part; those that the walls cut away make room for nothing.
  const double r = shape.chamber_radius;
  const dem::Box box{Vec3(-r, -r, 0.), Vec3(r, r, shape.top())};
  const auto grains = dem::draw_grains(sand, solid_fraction * box.volume(), generator);
  const dem::Particles all = dem::add_at_random(grains, box, 2650., generator());
  dem::Particles particles;
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    const Vec3 &x = all.position[i];
    const double gap = (shape.radius_at(x[2]) - std::hypot(x[0], x[1])) * std::cos(pi / 6.);
    if (gap > all.bounding_radius[i])
      particles.add(all.parts.shape[i], 2650., x, all.orientation[i]);
  }
  const double bottom = -shape.cone_height();
  add_walls(particles, shape, bottom);

  const dem::SimulationParameters parameters = parameters_of(recipe);
  auto simulation = std::make_unique<dem::Simulation>(
      parameters, std::move(particles), std::vector<dem::PlaneWall>{{Vec3(0., 0., bottom), Vec3::UnitZ()}});

  const auto n_steps = static_cast<std::int64_t>(std::ceil(recipe.flow_time / parameters.time_step));
  while (simulation->n_steps < n_steps)
  {
    simulation->step();
    if (simulation->n_steps % 500 == 0)
    {
      const FlowFigures f = flow_figures(*simulation);
      std::ostringstream line;
      line << "hourglass " << simulation->time << " of " << recipe.flow_time << " s: " << f.n_grains << " grains, "
           << f.coordination_number << " contacts a grain, speed " << f.mean_speed << " m/s, "
           << 100. * f.share_below_neck << " % below the neck, stable step " << simulation->stable_time_step() << " s";
      log(line.str());
    }
  }
  return simulation;
}

std::unique_ptr<dem::Simulation> cached_hourglass(const std::filesystem::path &folder, const HourglassRecipe &recipe,
                                                  const std::function<void(const std::string &)> &log)
{
  const std::filesystem::path path = folder / ("hourglass_" + std::to_string(recipe.n_grains) + ".h5");
  std::error_code ignored;
  if (std::filesystem::exists(path, ignored))
    try
    {
      auto hourglass = read_hourglass(path, recipe);
      log("hourglass read from " + path.string());
      return hourglass;
    }
    catch (const RunError &error)
    {
      log(std::string("hourglass made anew, because ") + error.what());
    }
  auto hourglass = flowing_hourglass(recipe, log);
  write_hourglass(path, recipe, *hourglass);
  log("hourglass kept in " + path.string());
  return hourglass;
}

} // namespace bergamo::benchmark
