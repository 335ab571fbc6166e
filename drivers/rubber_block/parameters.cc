#include "drivers/rubber_block/parameters.h"

#include "dem/core/error.h"
#include "dem/law/restitution.h"
#include "drivers/common/grain_parameters.h"
#include "drivers/common/run/step_count.h"
#include "drivers/common/smooth_step.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace bergamo::driver
{
namespace
{

void declare_elastic(ParameterFile &file, const std::string &section, fe::ElasticParameters &elastic)
{
  file.add(section, "Young's modulus", elastic.young_modulus, "[Pa]", Range::positive().usual(1e4, 1e12));
  file.add(section, "Poisson's ratio", elastic.poisson_ratio, "",
           {.lowest = 0, .highest = 0.5, .highest_included = false});
  file.add(section, "density", elastic.density, "[kg/m3]", Range::positive().usual(100, 2e4));
}

/// A of the viscoelastic law that two mean grains have at 1 m/s [s].
double relaxation_time_of(const RubberBlockParameters &p)
{
  const dem::Material &grain = p.simulation.grain();
  const double radius = p.mean_radius(), nu = grain.poisson_ratio;
  const double mass = 4. / 3. * std::numbers::pi * std::pow(radius, 3) * grain.density;
  const double stiffness = 4. / 3. * grain.young_modulus / (2. * (1. - nu * nu)) * std::sqrt(0.5 * radius);
  return dem::relaxation_time(p.restitution, stiffness, 0.5 * mass, 1.);
}

} // namespace

BlockParameters::BlockParameters()
{
  top = {.young_modulus = 94e6, .poisson_ratio = 0.3, .density = 3000.};
  rubber.elastic = {.young_modulus = 9.4e6, .poisson_ratio = 0.41, .density = 800.};
  rubber.second_share = 0.05;
}

void BlockParameters::declare(ParameterFile &file)
{
  file.add("Block", "edges", {edges.data(), 3}, "along the pull, across it, upright [m]",
           Range::positive().usual(1e-4, 10));
  file.add(
      "Block", "element", element, "quadratic: 27 nodes; bending: 8 nodes that bend; plain: 8 nodes",
      {{"quadratic", BlockElement::quadratic}, {"bending", BlockElement::bending}, {"plain", BlockElement::plain}});
  file.add("Block", "elements along", n_along, "", Range::between(3, 200));
  file.add("Block", "elements across", n_across, "", Range::between(1, 200));
  file.add("Block", "elements high", n_high, "", Range::between(2, 200));
  file.add("Block", "notch elements along", notch_along, "length of the groove across the middle of the bottom",
           Range::between(1, 198));
  file.add("Block", "notch elements high", notch_high, "its height", Range::between(1, 198));
  file.add("Block", "top layers", top_layers, "of elements, of the stiffer material", Range::between(1, 198));
  file.add("Block", "squares", squares, "of two triangles each, along the side of a face", Range::between(1, 8));
  declare_elastic(file, "Block/Top layer", top);
  declare_elastic(file, "Block/Rubber", rubber.elastic);
  file.add("Block/Rubber", "second share", rubber.second_share,
           "c of Mooney and Rivlin's law: of the second invariant in the shear modulus", Range::between(0, 1));
}

void BlockParameters::validate() const
{
  top.validate("Block/Top layer");
  rubber.validate();
  if (notch_along + 2 > n_along || (n_along - notch_along) % 2 != 0)
    reject("Block/notch elements along is ", notch_along, " of ", n_along,
           " (Block/elements along): the groove lies in the middle; leave as many elements before it as behind it");
  if (notch_high + top_layers > n_high)
    reject("Block/notch elements high is ", notch_high, ", of ", n_high, " (Block/elements high) less the top layers, ",
           top_layers, ": the groove ends in the rubber; make it lower");
}

RubberBlockParameters::RubberBlockParameters()
{
  simulation.grain() = {.young_modulus = 50e9, .poisson_ratio = 0.3, .density = 2550.};
  simulation.set_damping(0.);
  simulation.between_grains().friction = simulation.with_walls().friction = 0.24;
  simulation.time_step = 8e-8;
  output.snapshot_interval = 180;
}

void RubberBlockParameters::declare(ParameterFile &file)
{
  block.declare(file);
  sand.declare(file);
  declare_grains(file, simulation);
  file.add("Grains", "friction", simulation.between_grains().friction, "Coulomb's coefficient between grains",
           Range::non_negative().usual(0, 2));
  file.add("Grains", "box friction", simulation.with_walls().friction, "the same between grains and the rigid box",
           Range::non_negative().usual(0, 2));
  file.add("Grains", "block friction", block_friction, "the same between grains and block",
           Range::non_negative().usual(0, 2));
  file.add("Grains", "block contact modulus", contact_modulus,
           "Young's modulus of the block's skin in Hertz's law; grains sink into one as soft as rubber [Pa]",
           Range::positive().usual(1e4, 1e12));
  file.add("Grains", "restitution", restitution, "of two mean grains at 1 m/s: sets the viscoelastic law's A",
           Range::between(0.1, 1));
  declare_overlap_tolerance(file, "Grains", simulation.contact.overlap_tolerance);

  file.add("Pull", "gravity", gravity, "[m/s2]", Range::non_negative());
  file.add("Pull", "pressure", pressure, "on the block's top [Pa]", Range::positive().usual(100, 1e9));
  file.add("Pull", "loading time", loading_time, "over which the pressure grows, smoothly [s]", Range::positive());
  file.add("Pull", "holding time", holding_time, "under all of the pressure, before the pull [s]", Range::positive());
  file.add("Pull", "speed", speed, "of the block's top [m/s]", Range::positive().usual(1e-5, 1000));
  file.add("Pull", "start time", start_time, "over which the speed grows, smoothly [s]", Range::positive());
  file.add("Pull", "time", pull_time, "from its begin on [s]", Range::positive());
  file.add("Pull", "offset", start_offset, "of the block from the rear of the box, before the pull [m]",
           Range::positive());
  file.add("Pull", "time step", simulation.time_step, "while the block is there [s]", Range::positive());
  output.declare(file, "block and its surface are");
  file.add("Output", "grain pictures", n_grain_pictures,
           "times at which grains are written for ParaView, about 20 kB a grain", Range::between(2, 10000));
}

void RubberBlockParameters::validate() const
{
  block.validate();
  sand.validate(simulation.grain(), box());
  settling().validate();
  pulling().validate();
  n_steps();
  const double way = speed * (pull_time - 0.5 * std::min(start_time, pull_time));
  if (start_offset + block.edges[0] + way > sand.box[0])
    reject("Sand/box is ", sand.box[0], " m long: the block is pulled to ", start_offset + block.edges[0] + way,
           " m; give a longer box, or a shorter Pull/time");
  if (block.edges[1] > sand.box[1])
    reject("Block/edges is ", block.edges[1], " m across the pull, wider than Sand/box, ", sand.box[1], " m");
  sand.require_stable({"Pull/time step", simulation.time_step}, simulation.grain());
}

double RubberBlockParameters::mean_radius() const
{
  return std::cbrt(sand.distribution.mean_half_axes.prod());
}

dem::SimulationParameters RubberBlockParameters::pulling() const
{
  dem::SimulationParameters p = simulation;
  p.wall() = p.grain();
  p.gravity = {0., 0., -gravity};
  const fe::ElasticParameters &rubber = block.rubber.elastic;
  p.materials.add({contact_modulus, rubber.poisson_ratio, rubber.density});
  p.materials.between(dem::grain_material, block_material).friction = block_friction;
  p.set_damping(simulation.between_grains().damping_ratio, relaxation_time_of(*this));
  return p;
}

dem::SimulationParameters RubberBlockParameters::settling() const
{
  return sand.settling(pulling());
}

std::int64_t RubberBlockParameters::n_steps() const
{
  return steps_over({"Pull/loading time + holding time + time", end()}, {"Pull/time step", simulation.time_step});
}

double RubberBlockParameters::pressure_at(const double time) const
{
  return pressure * smooth_step(time / loading_time);
}

double RubberBlockParameters::speed_at(const double time) const
{
  return speed * smooth_step((time - pull_begin()) / start_time);
}

} // namespace bergamo::driver
