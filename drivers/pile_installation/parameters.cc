#include "drivers/pile_installation/parameters.h"

#include "dem/core/error.h"
#include "dem/packing/tightening.h"
#include "drivers/common/coupling_parameters.h"
#include "drivers/common/grain_parameters.h"
#include "drivers/common/run/step_count.h"
#include "drivers/common/smooth_step.h"

#include <algorithm>
#include <cmath>

namespace bergamo::driver
{

InstallationParameters::InstallationParameters()
{
  simulation.grain() = {.young_modulus = 2e7, .poisson_ratio = 0.2, .density = 2650.};
  simulation.set_damping(0.3);
  simulation.between_grains().friction = 0.24;
  simulation.with_walls().friction = 0.;
  simulation.time_step = 5e-6;
  sand.box = Vec3(60e-3, 4e-3, 26e-3);
  sand.solid_fraction = 0.55;
  sand.settling_gravity = 9.81;
  sand.settling_time = 0.15;
  sand.settling_step = 1e-5;
  continuum.mohr_coulomb = {.young_modulus = 1.6e5,
                            .poisson_ratio = 0.216,
                            .friction_angle = 24.,
                            .dilation_angle = 0.,
                            .cohesion = 0.2,
                            .density = 1700.,
                            .reference_pressure = 400.,
                            .stiffness_exponent = 0.33};
  coupling.penalty = 5e11;
  coupling.edge.stiffness = 2e12;
  coupling.transfer_time = 1e-3;
  coupling.renewal = 0.1;
  coupling.surface_reach = 3.;
  output.n_samples = 100;
}

void InstallationParameters::declare(ParameterFile &file)
{
  file.add("Model", "kind", kind, "what the ground is: grains about the pile and elements beyond, or grains alone",
           {{"two-scale", GroundKind::two_scale}, {"grains", GroundKind::grains}});
  file.add("Model", "weight", weight, "how the grains' weights grow through the overlap",
           {{"linear", coupling::WeightShape::linear}, {"smooth", coupling::WeightShape::smooth}});
  file.add("Model", "block width", block_width,
           "of the grains that stay, along x, to the outer edge of the overlap; the pile is in its middle [m]",
           Range::positive().usual(1e-4, 10));
  file.add("Model", "block depth", block_depth, "the same from the settled sand's level down [m]",
           Range::positive().usual(1e-4, 10));
  file.add("Model", "growth depth", growth_depth,
           "by which the block may grow downwards as the pile comes near its end, in whole elements; 0: never [m]",
           Range::non_negative());
  file.add("Model", "growth distance", growth_distance,
           "of the tip above the overlap below it, where the next layer of elements becomes grains [m]",
           Range::non_negative());
  file.add("Model", "beyond sides", beyond_sides, "width of the elements beyond the box of sand, on each side [m]",
           Range::non_negative());
  file.add("Model", "beyond bottom", beyond_bottom, "the same below it [m]", Range::non_negative());
  file.add("Model", "element size", mesh.element_size, "in the overlap [m]", Range::positive().usual(1e-4, 10));
  file.add("Model", "overlap layers", mesh.overlap_layers, "of elements, at the sides and at the bottom of the block",
           Range::between(1, 20));
  file.add("Model", "layers across", mesh.layers_across, "of elements along y", Range::between(1, 100));
  file.add("Model", "growth", mesh.growth, "of the elements outwards, from one to the next", Range::between(1, 2));
  file.add("Model", "bending elements", bending_elements,
           "one law for each hexahedron, and a stiffness of its own where it bends");
  file.add("Model", "large strain", large_strain,
           "elements of the present shape, for soil that strains by more than a percent or turns; not of bending ones");

  file.add("Pile", "kind", pile.kind, "pile: from the box's front to its back, plane strain; cone: round",
           {{"pile", IntruderKind::pile}, {"cone", IntruderKind::cone}});
  pile.declare(file, "Pile");
  file.add("Pile", "friction", pile_friction, "Coulomb's coefficient between grains and pile",
           Range::non_negative().usual(0, 2));
  file.add("Pile", "drive", drive, "what is given: the pile's speed, or the force on its head",
           {{"speed", PileDrive::speed}, {"force", PileDrive::force}});
  file.add("Pile", "speed", speed, "downwards; 0: the pile stays above the sand [m/s]",
           Range::non_negative().usual(1e-5, 100));
  file.add("Pile", "head force", head_force, "at the end, in proportion to the time until then [N]", Range::positive());
  file.add("Pile", "mass", pile_mass, "inertia of a pile that a force drives; it has no weight [kg]",
           Range::positive());
  file.add("Pile", "time", time, "of the installation [s]", Range::positive());
  file.add("Pile", "start time", start_time, "over which the speed grows, smoothly [s]", Range::positive());
  file.add("Pile", "time step", simulation.time_step, "[s]", Range::positive());

  sand.declare(file);
  file.add(
      "Sand", "tiles", tiles,
      "of which the sand is made up along x: one is packed and settled, repeating itself along x, and copies of it lie "
      "side by side; 0: the whole box is filled. Of two-scale ground alone, which needs no walls there",
      Range::between(0, 1000));
  file.add("Sand/Settling", "friction", settling_friction, "between grains while they settle: less gives denser sand",
           Range::non_negative());
  declare_grains(file, simulation);
  file.add("Grains", "friction", simulation.between_grains().friction, "Coulomb's coefficient between grains",
           Range::non_negative().usual(0, 2));
  declare_overlap_tolerance(file, "Grains", simulation.contact.overlap_tolerance);

  continuum.declare(file);
  file.add("Continuum", "damping", continuum_damping, "mass-proportional [1/s]", Range::non_negative());
  declare_coupling(file, coupling);
  fields.declare(file);
  output.declare(file, "grains, pile, mesh, contacts and fields are");
}

void InstallationParameters::validate() const
{
  sand.validate(simulation.grain(), box());
  if (tiles > 0)
    validate_tiles();
  sand.require_stable({"Pile/time step", simulation.time_step}, simulation.grain());
  settling().validate();
  installing().validate();
  n_steps();
  validate_pile();
  fields.validate(sand.box);
  if (bending_elements && large_strain)
    reject("Model/large strain has no bending elements; choose one of Model/bending elements and Model/large strain");
  if (is_two_scale())
    validate_plan();
}

void InstallationParameters::validate_pile() const
{
  if (drive == PileDrive::speed && 0.5 * start_time > time)
    reject("Pile/start time is ", start_time, " s, more than twice Pile/time, ", time, " s; choose a shorter one");
  constexpr double densest = 0.74;
  const double lowest_level = sand.box[2] * sand.solid_fraction / densest,
               ground = is_two_scale() ? std::min(deepest_block(), lowest_level) : lowest_level;
  if (final_way() > ground)
    reject("the pile goes ", final_way(), " m down (Pile/speed, Pile/time), but the grains may be only ", ground,
           " m deep; choose less, a deeper Model/block depth or growth depth, or a higher Sand/box");
  if (pile.width >= sand.box[0])
    reject("Pile/width is ", pile.width, " m; choose less than the length of Sand/box, ", sand.box[0], " m");
  if (pile.kind == IntruderKind::cone && pile.width >= sand.box[1])
    reject("Pile/width is ", pile.width, " m across; choose less than the breadth of Sand/box, ", sand.box[1], " m");
}

void InstallationParameters::validate_tiles() const
{
  if (!is_two_scale())
    reject("Sand/tiles is ", tiles,
           ", but ground of grains alone needs walls at its ends, through which the copies' grains "
           "would reach; choose 0, or Model/kind = two-scale");
  if (!sand.grains_file.empty())
    reject("Sand/tiles is ", tiles, ", but Sand/grains file is the packing of a whole box; choose 0, or no file");
  const double largest = std::sqrt(3.) * sand.distribution.largest_half_axis, // bounding radius, at most
      least = 2. * dem::tightening_range(largest);
  if (tile().edges()[0] <= least)
    reject("Sand/tiles is ", tiles, ", which makes tiles of ", tile().edges()[0], " m: they must be wider than ", least,
           " m, so that no grain meets another one twice; choose fewer");
}

void InstallationParameters::validate_plan() const
{
  coupling.validate();
  continuum.validate();
  constexpr double densest = 0.74;
  const double lowest_level = sand.box[2] * sand.solid_fraction / densest,
               overlap = mesh.overlap_layers * mesh.element_size;
  if (block_width > sand.box[0])
    reject("Model/block width is ", block_width, " m; choose at most the length of Sand/box, ", sand.box[0], " m");
  if (deepest_block() > lowest_level)
    reject("Model/block depth is ", block_depth, " m and may grow to ", deepest_block(),
           " m, but the settled sand may be only ", lowest_level, " m high; choose less, or a higher Sand/box");
  const double at_side = 0.5 * (sand.box[0] - block_width) + beyond_sides,
               below = lowest_level - deepest_block() + beyond_bottom;
  if (at_side < mesh.element_size || below < mesh.element_size)
    reject("beyond the block of grains there would be ", at_side, " m of elements on each side and perhaps only ",
           below, " m below, less than Model/element size, ", mesh.element_size,
           " m; choose a smaller Model/block width or block depth, or more ground by Model/beyond sides or bottom");
  const double grain = 2. * sand.distribution.mean_half_axes.mean();
  if (mesh.element_size < grain)
    reject("Model/element size is ", mesh.element_size, " m, less than a mean grain of ", grain, " m; choose more");
  const double least_width = 2. * overlap + pile.width + 4. * grain, least_depth = overlap + 4. * grain;
  if (block_width < least_width || deepest_block() < least_depth + final_way() || block_depth < least_depth)
    reject("Model/block width and block depth are ", block_width, " and ", block_depth, " m: with overlaps of ",
           overlap, " m and two grains beside the pile they must be at least ", least_width,
           " and, with the pile's way, ", least_depth + final_way(), " m");
  const double vertical = 0.5 * mesh.element_size * continuum.density() * gravity();
  continuum.require_pressure(vertical * 2. / 3., "half an element below the surface the ground has",
                             "raise Sand/Settling/gravity");
}

dem::Box InstallationParameters::box() const
{
  const Vec3 half(0.5 * sand.box[0], 0.5 * sand.box[1], 0.);
  return {-half, half + sand.box[2] * Vec3::UnitZ()};
}

dem::Box InstallationParameters::tile() const
{
  const dem::Box whole = box();
  return {{0., whole.low[1], 0.}, {whole.edges()[0] / tiles, whole.high[1], whole.high[2]}};
}

dem::SimulationParameters InstallationParameters::installing() const
{
  dem::SimulationParameters p = simulation;
  p.wall() = p.grain();
  p.gravity = {0., 0., -gravity()};
  p.materials.add(p.grain());
  p.materials.between(dem::grain_material, intruder_material).friction = pile_friction;
  p.set_damping(simulation.between_grains().damping_ratio);
  return p;
}

dem::SimulationParameters InstallationParameters::settling() const
{
  dem::SimulationParameters p = sand.settling(installing());
  p.between_grains().friction = settling_friction;
  return p;
}

GroundPlan InstallationParameters::plan(const double level) const
{
  const double overlap = mesh.overlap_layers * mesh.element_size;
  GroundPlan plan;
  plan.half_width = 0.5 * sand.box[0] + beyond_sides;
  plan.half_breadth = 0.5 * sand.box[1];
  plan.bottom = -beyond_bottom;
  plan.top = level;
  plan.outer_half_width = 0.5 * block_width;
  plan.inner_half_width = plan.outer_half_width - overlap;
  plan.outer_bottom = level - block_depth;
  plan.inner_bottom = plan.outer_bottom + overlap;
  plan.deepest_bottom = plan.outer_bottom - n_growths() * mesh.element_size;
  return plan;
}

IntruderShape InstallationParameters::shape() const
{
  IntruderShape s = pile;
  if (s.kind == IntruderKind::pile)
    s.breadth = sand.box[1];
  return s;
}

Intruder InstallationParameters::make_pile(const double height) const
{
  const double largest_grain = 2. * sand.distribution.largest_half_axis;
  const IntruderShape s = shape();
  const double length = s.tip_height() + sand.box[2] + 2. * largest_grain; // longer than any way
  Intruder made = make_intruder(s, height * Vec3::UnitZ(), length, largest_grain);
  if (drive == PileDrive::force)
  {
    made.body.inertia.mass = pile_mass;
    made.body.guide.velocity[2].reset();
  }
  return made;
}

double InstallationParameters::speed_at(const double now) const
{
  return drive == PileDrive::speed ? speed * smooth_step(now / start_time) : 0.;
}

double InstallationParameters::force_at(const double now) const
{
  return drive == PileDrive::force ? head_force * std::clamp(now / time, 0., 1.) : 0.;
}

int InstallationParameters::n_growths() const
{
  constexpr double rounding = 1e-9;
  return static_cast<int>(growth_depth / mesh.element_size + rounding);
}

std::int64_t InstallationParameters::n_steps() const
{
  return steps_over({"Pile/time", time}, {"Pile/time step", simulation.time_step});
}

} // namespace bergamo::driver
