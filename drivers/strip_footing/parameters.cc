#include "drivers/strip_footing/parameters.h"

#include "dem/core/error.h"
#include "drivers/common/number_text.h"
#include "drivers/strip_footing/bearing_capacity.h"

#include <cstdint>
#include <limits>

namespace bergamo::driver
{

FootingParameters::FootingParameters()
{
  continuum.mohr_coulomb = {.young_modulus = 20e6,
                            .poisson_ratio = 0.3,
                            .friction_angle = 0,
                            .dilation_angle = 0,
                            .cohesion = 10e3,
                            .density = 1800};
  deeper.fill(continuum);
  output.n_pictures = 2;
}

void FootingParameters::declare(ParameterFile &file)
{
  file.add("Footing", "width", width, "B [m]", Range::positive().usual(0.01, 1000));
  file.add("Footing", "rough", rough, "no slip between footing and ground");
  file.add("Footing", "settlement", settlement, "at the end [m]", Range::positive().usual(1e-5, 100));
  file.add("Footing", "loading time", loading_time, "long against the time of a wave over the ground [s]",
           Range::positive());
  file.add("Footing", "ramp", ramp, "share of the loading time in which the footing speeds up",
           Range::strictly_between(0, 1));

  file.add("Ground", "width", ground_width, "from the axis of symmetry, more than half of the footing [m]",
           Range::positive());
  file.add("Ground", "depth", ground_depth, "[m]", Range::positive());
  file.add("Ground", "elements under half the footing", elements_across,
           "whose nodes are all held, beside a half one at the edge; sets the size of all elements",
           Range::between(1, 200));
  file.add("Ground", "element degree", degree, "1: hexahedra of 8 nodes; 2: of 27 nodes", Range::between(1, 2));
  file.add("Ground", "bending elements", bending_elements,
           "of degree 1: one law for each, and a stiffness of their own where they bend");
  file.add("Ground", "large strain", large_strain,
           "elements of the present shape, for soil that strains by more than a percent or turns; not of bending ones");
  file.add("Ground", "gravity", gravity, "downwards; 0: weightless [m/s2]", Range::non_negative().usual(0.1, 1e4));
  file.add("Ground", "surcharge", surcharge, "on the whole surface [Pa]", Range::non_negative());
  file.add("Ground", "earth pressure at rest", earth_pressure_at_rest, "K0: horizontal over vertical stress at rest",
           Range::non_negative().usual(0.1, 5));
  file.add("Ground", "far boundaries", far_boundaries,
           "far side and bottom; quiet ones let waves leave, but give way to what presses for long",
           {{"held", FarBoundaries::held}, {"quiet", FarBoundaries::quiet}});
  file.add(
      "Ground", "layer depths", layer_depths,
      "where Layer 2, Layer 3 and Layer 4 begin, each at the next edge of elements; empty: one layer, Continuum [m]",
      Range::positive());

  continuum.declare(file);
  for (std::size_t k = 0; k < deeper.size(); ++k)
    deeper[k].declare(file, "Layer " + std::to_string(k + 2));
  file.add("Continuum", "damping", damping, "mass-proportional [1/s]", Range::non_negative());

  file.add("Output", "step share", step_share, "of the stable time step", Range::strictly_between(0, 1).usual(0.05, 1));
  output.declare(file, "the mesh is");
}

void FootingParameters::validate() const
{
  continuum.validate();
  if (layer_depths.size() > deeper.size())
    reject("Ground/layer depths has ", layer_depths.size(), " depths: there are materials for ", deeper.size(),
           " deeper layers, Layer 2 to Layer ", deeper.size() + 1);
  for (std::size_t k = 0; k < layer_depths.size(); ++k)
  {
    deeper[k].validate();
    if (k > 0 && !(layer_depths[k] > layer_depths[k - 1]))
      reject("Ground/layer depths: ", layer_depths[k], " m follows ", layer_depths[k - 1],
             " m; give them from the surface downwards");
  }
  if (ground_width < width)
    reject(
        "Ground/width is ", ground_width, " m beside a footing of ", width,
        " m (Footing/width): the ground has to reach at least from the axis to half a width beyond the footing's edge");
  if (ground_depth < element_size())
    reject("Ground/depth is ", ground_depth, " m, less than an element of ", element_size(),
           " m; choose more elements under half the footing or deeper ground");
  const double unknowns =
      3. * (degree + 1.) * (degree * elements_along(ground_width) + 1.) * (degree * elements_along(ground_depth) + 1.);
  if (unknowns > std::numeric_limits<std::uint32_t>::max())
    reject("the ground would have ", elements_along(ground_width), " x ", elements_along(ground_depth),
           " elements, more than can be numbered; choose a smaller Ground/width or Ground/depth, or fewer "
           "Ground/elements under half the footing");
  if (bending_elements && degree != 1)
    reject("Ground/bending elements are of degree 1, but Ground/element degree is ", degree,
           "; choose degree 1, or no bending elements: those of 27 nodes bend anyway");
  if (large_strain && (bending_elements || degree != 1))
    reject("Ground/large strain has elements of degree 1 alone that do not bend; choose Ground/element degree = 1 and no "
           "Ground/bending elements, or small strain");
  if (!(limit_pressure().davis > 0))
    reject("the ground bears no footing: ",
           continuum.is_sand() ? "" : "Continuum/cohesion is " + short_text(continuum.mohr_coulomb.cohesion) + ", ",
           "Ground/surcharge is ", surcharge, " and Ground/gravity ", gravity, "; one of them must be positive");
  const double vertical = surcharge + 0.5 * element_size() * continuum.density() * gravity;
  continuum.require_pressure(vertical * (1 + 2 * earth_pressure_at_rest) / 3,
                             "half an element below the surface the ground has", "raise Ground/surcharge");
  if (settlement > 0.2 * width)
    reject("Footing/settlement is ", settlement, " m: strains are small up to about a fifth of Footing/width, ",
           0.2 * width, " m");
}

void LimitPressure::add_figures(Summary &summary, const double bearing) const
{
  summary.set("limit_pressure_Pa", davis, "Pa");
  summary.set("limit_pressure_associated_Pa", associated, "Pa");
  summary.set("bearing_over_limit", bearing / davis);
}

LimitPressure FootingParameters::limit_pressure() const
{
  const auto pressure = [&](const Strength &strength)
  {
    const BearingFactors n = bearing_factors(strength.friction_angle, rough);
    return strength.cohesion * n.cohesion + surcharge * n.surcharge +
           0.5 * continuum.density() * gravity * width * n.weight;
  };
  const Strength full = continuum.is_sand()
                            ? Strength{continuum.sand.critical_friction_angle, 0}
                            : Strength{continuum.mohr_coulomb.friction_angle, continuum.mohr_coulomb.cohesion};
  const double dilation_angle = continuum.is_sand() ? 0 : continuum.mohr_coulomb.dilation_angle;
  return {pressure(davis_strength(full, dilation_angle)), pressure(full)};
}

} // namespace bergamo::driver
