#include "benchmarks/settled_packing.h"

#include "benchmarks/engine_figures.h"
#include "dem/core/error.h"
#include "dem/loading/compression.h"
#include "dem/packing/distribution.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

namespace bergamo::benchmark
{
namespace
{

// The route. Scaling stiffness and pressure by one factor only scales time, so a softer sand would need as many steps:
// what costs steps is a small overlap. Hence the grains, still without friction, are first pressed far harder than
// wanted, where overlaps are large and all grains are held. Then the whole packing is widened evenly by the strain that
// takes its overlaps to those of the wanted pressure. Friction comes last: it ends the slow creep of loose grains at
// once, and keeps the contacts that the frictionless sand has made.
constexpr double packing_fraction = 0.2;    // of the random addition
constexpr double press_factor = 100.;       // pressure while pressed over the wanted one
constexpr double packing_damping = 0.3;     // rings out fastest; much damping would ask for small steps
constexpr double packing_step_share = 0.6;  // of the stable step
constexpr double contraction_share = 0.3;   // kinetic energy of the contraction over that of the pressure
constexpr double contraction_step = 1.5e-7; // collisions at that speed need it [s]
constexpr double contraction_verlet = 0.4;  // far movers would ask for new neighbours every few steps
constexpr double drag = 0.3;                // on the grains, see settle()
constexpr int adaption_interval = 500;      // steps between two estimates of the stable step
constexpr int rest_steps = 500;             // with everything as in the measured run

/// What ends a stage of settling.
struct StageEnd
{
  double pressure;     ///< [Pa]
  double unbalance;    ///< mean unbalanced over mean contact force
  double tolerance;    ///< of the pressure
  int longest;         ///< [steps]
  double longest_step; ///< [s]
};

dem::Particles place_grains(const PackingRecipe &recipe, dem::Box &box)
{
  std::mt19937_64 generator(recipe.seed);
  std::vector<dem::Superquadric> grains;
  double solid_volume = 0.;
  for (int i = 0; i < recipe.n_grains; ++i)
  {
    dem::Superquadric grain = dem::draw_grain({}, generator);
    if (recipe.kind == GrainKind::spheres)
    {
      const double radius = dem::equivalent_radius(grain);
      grain = {};
      grain.half_axes.setConstant(radius);
    }
    solid_volume += dem::volume(grain);
    grains.push_back(grain);
  }
  box = {Vec3::Zero(), Vec3::Constant(std::cbrt(solid_volume / packing_fraction))};
  return dem::add_at_random(grains, box, sand_parameters().grain().density, generator());
}

double solid_volume(const dem::Simulation &simulation)
{
  double sum = 0.;
  for (const dem::Superquadric &shape : simulation.particles.parts.shape)
    sum += dem::volume(shape);
  return sum;
}

/// Walls and grains fly towards the centre, all at speeds proportional to their places, so that the grains come
/// together everywhere at once.
std::unique_ptr<dem::Simulation> contract(const PackingRecipe &recipe)
{
  dem::Box box;
  dem::Particles particles = place_grains(recipe, box);
  const Vec3 centre = 0.5 * (box.low + box.high);
  dem::SimulationParameters parameters = sand_parameters();
  parameters.between_grains().friction = 0.;
  parameters.set_damping(packing_damping);
  parameters.time_step = contraction_step;
  parameters.verlet_distance = contraction_verlet;
  parameters.contact.overlap_tolerance = 0.1;

  const double dense = recipe.kind == GrainKind::spheres ? 0.60 : 0.64; // shortly before the grains jam
  const double speed =
      std::sqrt(contraction_share * press_factor * recipe.pressure / (dense * parameters.grain().density));
  for (std::size_t i = 0; i < particles.size(); ++i)
    particles.velocity[i] = speed / centre.x() * (centre - particles.position[i]);
  auto simulation = std::make_unique<dem::Simulation>(parameters, std::move(particles), dem::box_walls(box));
  for (dem::PlaneWall &wall : simulation->walls)
    wall.velocity = speed * wall.normal;
  const double end_volume = solid_volume(*simulation) / dense;
  while (dem::box_between(simulation->walls).volume() > end_volume)
    simulation->step();
  return simulation;
}

/// Brings the walls to a pressure and the grains to rest. @return whether all of `end` but its steps were reached
bool settle(dem::Simulation &simulation, const StageEnd &end)
{
  dem::CompressionParameters compression_parameters;
  compression_parameters.pressure = end.pressure;
  compression_parameters.pressure_tolerance = end.tolerance;
  compression_parameters.force_tolerance = end.unbalance;
  compression_parameters.largest_rate = 1000.;
  compression_parameters.longest_time = 10.; // the steps are counted here
  dem::Compression compression(compression_parameters);

  // The dashpots hardly slow the waves across the box, whose period grows with the number of grains along it: a drag
  // on the grains does, with a rate over the step that falls with that number.
  dem::SimulationParameters parameters = simulation.parameters();
  dem::Particles &particles = simulation.particles;
  for (int n = 0; n < end.longest && !compression.is_finished(); ++n)
  {
    if (n % adaption_interval == 0)
    {
      simulation.compute_forces();
      const double stable = simulation.stable_time_step();
      parameters.time_step = std::min(packing_step_share * stable, end.longest_step);
      simulation.change(parameters);
    }
    const double rate = drag / (std::cbrt(particles.size()) * parameters.time_step);
    particles.external_force.resize(particles.size());
    for (std::size_t i = 0; i < particles.size(); ++i)
      particles.external_force[i] = -rate * particles.mass[i] * particles.velocity[i];
    compression.step(simulation);
  }
  particles.external_force.clear();
  for (dem::PlaneWall &wall : simulation.walls)
    wall.velocity.setZero();
  return compression.is_finished();
}

/// The same grains at rest, moved apart evenly by a strain, between walls moved alike; contacts begin anew.
std::unique_ptr<dem::Simulation> widened(const dem::Simulation &pressed, const double strain)
{
  dem::SimulationParameters parameters = pressed.parameters();
  parameters.contact.overlap_tolerance = 5e-2;
  parameters.verlet_distance = sand_parameters().verlet_distance;
  dem::Particles particles;
  for (std::size_t i = 0; i < pressed.particles.size(); ++i)
    particles.add(pressed.particles.parts.shape[i], parameters.grain().density,
                  (1. + strain) * pressed.particles.position[i], pressed.particles.orientation[i]);
  dem::Box box = dem::box_between(pressed.walls);
  box.low *= 1. + strain;
  box.high *= 1. + strain;
  return std::make_unique<dem::Simulation>(parameters, std::move(particles), dem::box_walls(box));
}

/// The sand's parameters with its time step; the step's estimate needs the sand's own damping.
dem::SimulationParameters final_parameters(dem::Simulation &simulation)
{
  dem::SimulationParameters parameters = sand_parameters();
  parameters.time_step = step_share * simulation.parameters().time_step;
  simulation.change(parameters);
  simulation.compute_forces();
  parameters.time_step = step_share * simulation.stable_time_step();
  return parameters;
}

std::string describe(const std::string &stage, const dem::Simulation &simulation)
{
  const PackingFigures f = packing_figures(simulation);
  std::ostringstream text;
  text << stage << ": solid fraction " << f.solid_fraction << ", coordination " << f.coordination_number
       << ", unbalanced force " << f.unbalanced_force << ", pressure " << f.pressure / 1e3 << " kPa";
  return text.str();
}

void require_settled(const dem::Simulation &simulation, const PackingRecipe &recipe)
{
  const PackingFigures f = packing_figures(simulation);
  if (f.coordination_number >= 4. && f.unbalanced_force < 0.01 &&
      std::abs(f.pressure - recipe.pressure) < 0.05 * recipe.pressure)
    return;
  std::ostringstream message;
  message << describe("the packing of " + std::to_string(recipe.n_grains) + ' ' + name(recipe.kind), simulation)
          << ": it must have at least 4 contacts a grain, less than 0.01 and be within 5 % of " << recipe.pressure / 1e3
          << " kPa; choose more grains or another seed";
  throw RunError(message.str());
}

} // namespace

std::string name(const GrainKind kind)
{
  return kind == GrainKind::superquadrics ? "superquadrics" : "spheres";
}

dem::SimulationParameters sand_parameters()
{
  return {}; // the engine's defaults are the sand's
}

PackingFigures packing_figures(const dem::Simulation &simulation)
{
  PackingFigures figures;
  figures.solid_fraction = solid_volume(simulation) / dem::box_between(simulation.walls).volume();
  figures.coordination_number = 2. * n_touching(simulation) / simulation.particles.size();
  figures.unbalanced_force = dem::unbalanced_force(simulation);
  figures.pressure = dem::wall_pressure(simulation.walls).mean();
  return figures;
}

std::unique_ptr<dem::Simulation> settle_packing(const PackingRecipe &recipe,
                                                const std::function<void(const std::string &)> &log)
{
  std::unique_ptr<dem::Simulation> simulation = contract(recipe);
  log(describe("contracted", *simulation));
  settle(*simulation, {press_factor * recipe.pressure, 0.1, 0.02, 2500, contraction_step});
  log(describe("pressed", *simulation));

  // Strain = overlap over distance, and overlap ~ pressure^(2/3) (Hertz); a tenth less, as contacts open unevenly.
  const double strain = 0.9 * (1. - std::pow(press_factor, -2. / 3.)) * mean_relative_overlap(*simulation);
  simulation = widened(*simulation, strain);
  // Spheres gain contacts as long as they relax, and few of them, many of which touch walls, need that more.
  const int sphere_steps = std::clamp(40'000'000 / recipe.n_grains, 3000, 10000);
  const StageEnd release = recipe.kind == GrainKind::spheres
                               ? StageEnd{recipe.pressure, 0.003, 0.02, sphere_steps, 4e-7}
                               : StageEnd{recipe.pressure, 0.1, 0.02, 2500, 4e-7};
  settle(*simulation, release);
  log(describe("released", *simulation));

  dem::SimulationParameters parameters = sand_parameters();
  parameters.set_damping(packing_damping);
  parameters.time_step = simulation->parameters().time_step;
  parameters.contact.overlap_tolerance = 1e-3;
  simulation->change(parameters);
  settle(*simulation, {recipe.pressure, 0.003, 0.01, 5000, 4e-7});
  log(describe("with friction", *simulation));

  simulation->change(final_parameters(*simulation));
  for (int n = 0; n < rest_steps; ++n)
    simulation->step();
  simulation->reset_accounts();
  log(describe("settled", *simulation));
  require_settled(*simulation, recipe);
  return simulation;
}

} // namespace bergamo::benchmark
