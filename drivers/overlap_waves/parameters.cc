#include "drivers/overlap_waves/parameters.h"

#include "dem/core/error.h"
#include "drivers/common/coupling_parameters.h"
#include "drivers/common/grain_parameters.h"
#include "drivers/common/run/step_count.h"

#include <cmath>
#include <numbers>

namespace bergamo::driver
{

WaveParameters::WaveParameters()
{
  simulation.time_step = 4e-7;
  simulation.set_damping(0.);
}

void WaveParameters::declare(ParameterFile &file)
{
  file.add("Column", "kind", kind, "two-scale, or the grains in place of the continuum, too",
           {{"two-scale", ColumnKind::two_scale}, {"grains", ColumnKind::grains}});
  file.add("Column", "width", width, "grains across, periodic", Range::between(3, 100));
  file.add("Column", "element size", element_size, "along the column, in distances of grains", Range::between(1, 100));
  file.add("Column", "overlap layers", overlap_layers, "of elements, shared with the grains", Range::between(1, 200));
  file.add("Column", "weight", weight, "how the grains' weights grow through the overlap",
           {{"linear", coupling::WeightShape::linear}, {"smooth", coupling::WeightShape::smooth}});
  file.add("Column", "room", room, "length of either part outside of the overlap, over that of pulse and overlap",
           Range::between(1, 10));

  file.add("Pulse", "wave", wave, "", {{"compression", Wave::compression}, {"shear", Wave::shear}});
  file.add("Pulse", "from", source, "the end of the column that sends it; with grains alone, where that would be",
           {{"grains", PulseSource::grains}, {"continuum", PulseSource::continuum}});
  file.add("Pulse", "wave length", wave_length, "in the grains, in their distances", {.lowest = 2.5, .highest = 1000.});
  file.add("Pulse", "waves", n_waves, "that it has", Range::between(1, 100));
  file.add("Pulse", "amplitude", amplitude, "of its strain, over that of the contacts under the pressure",
           {.lowest = 0., .highest = 0.1, .lowest_included = false});

  file.add("Grains", "radius", radius, "[m]", Range::positive().usual(1e-6, 0.1));
  file.add("Grains", "pressure", pressure, "that the lattice bears [Pa]", Range::positive().usual(100, 1e9));
  declare_grains(file, simulation);
  file.add("Grains", "friction", simulation.between_grains().friction, "Coulomb's coefficient", Range::positive());
  declare_coupling(file, coupling);
  file.add("Output", "time step", simulation.time_step, "[s]", Range::positive());
  output.declare(file, "the column is");
}

void WaveParameters::validate() const
{
  simulation.validate();
  const CubicLattice l = lattice();
  if (!(l.overlap < 0.1 * radius))
    reject("Grains/pressure is ", pressure, " Pa: the grains overlap by ", l.overlap,
           " m, more than a tenth of their radius; lower it or raise Grains/Young's modulus");
  if (l.tangential >= l.normal)
    reject("Grains/Poisson's ratio is ", simulation.grain().poisson_ratio,
           ": the lattice is stiffer in shear than any solid of positive Poisson's ratio; raise it");
  const double limit = 2. * l.speed(wave) / element_height();
  if (kind == ColumnKind::two_scale && source == PulseSource::continuum && pulse().frequency > 0.9 * limit)
    reject("Pulse/wave length is ", wave_length, " grains: elements of ", element_size,
           " carry no wave that short, so none can come from the continuum; choose a longer one, a smaller "
           "Column/element size or Pulse/from = grains");
  n_steps();
}

Pulse WaveParameters::pulse() const
{
  const CubicLattice l = lattice();
  Pulse pulse;
  pulse.wave = wave;
  pulse.frequency = l.frequency(wave, 2. * std::numbers::pi / (wave_length * l.spacing));
  pulse.duration = n_waves * 2. * std::numbers::pi / pulse.frequency;
  pulse.amplitude = amplitude * l.overlap / l.spacing * l.modulus(wave);
  return pulse;
}

double WaveParameters::source_velocity() const
{
  const CubicLattice l = lattice();
  if (kind == ColumnKind::grains || source == PulseSource::grains)
    return l.group_velocity(wave, 2. * std::numbers::pi / (wave_length * l.spacing));
  const double c = l.speed(wave), sine = 0.5 * pulse().frequency * element_height() / c; // lumped masses
  return c * std::sqrt(1. - sine * sine);
}

unsigned int WaveParameters::part_layers() const
{
  const double h = element_height();
  return static_cast<unsigned int>(std::ceil(room * (lattice().speed(wave) * pulse().duration / h + overlap_layers)));
}

std::int64_t WaveParameters::n_steps() const
{
  const double way = (part_layers() + overlap_layers) * element_height();
  return steps_over({"Pulse/wave length x waves", pulse().duration + way / source_velocity()},
                    {"Output/time step", simulation.time_step});
}

} // namespace bergamo::driver
