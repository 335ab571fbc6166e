#include "drivers/fit_mohr_coulomb/parameters.h"

#include <algorithm>
#include <cmath>

namespace bergamo::driver
{

void FitParameters::declare(ParameterFile &file)
{
  file.add("Ensemble", "folder", ensemble,
           "run folder of rve_triaxial with ensemble.csv, from where the program starts");
  file.add("Ensemble", "edges", choice.edges, "only samples with these edges of the cell [m]; empty: all",
           Range::positive().usual(1e-4, 10));
  file.add("Ensemble", "generation frictions", choice.generation_frictions,
           "only samples packed with these friction coefficients; empty: all", Range::non_negative());
  file.add("Ensemble", "pressures", choice.pressures, "only samples under these confining pressures [Pa]; empty: all",
           Range::positive());

  file.add("Elasticity", "axial strain", windows.elastic_strain,
           "Young's modulus and Poisson's ratio are slopes from the start of the shear to this compression",
           Range::strictly_between(0, 1));
  file.add("Elasticity", "pressures", young_pressures,
           "Young's modulus is the mean over samples under these confining pressures [Pa]; empty: all",
           Range::positive());

  file.add("Elasticity", "stiffness", stiffness_law,
           "constant: the mean Young's modulus at any pressure; power: it grows with the confining pressure, E = E_r "
           "(p/p_r)^m, by least squares of the logarithms",
           {{"constant", StiffnessLaw::constant}, {"power", StiffnessLaw::power}});
  file.add("Elasticity", "reference pressure", reference_pressure, "p_r of the power law [Pa]", Range::positive());

  file.add("Strength", "averaged strain", windows.peak_average,
           "width in axial strain over which stresses are averaged before the largest is sought; 0: none",
           {.lowest = 0, .highest = 1, .highest_included = false});
  file.add("Strength", "cohesion from", cohesion_source,
           "given: as below; common tangent: of the line nearest to the circles of all samples (least squares)",
           {{"given", CohesionSource::given}, {"common tangent", CohesionSource::common_tangent}});
  file.add("Strength", "cohesion", cohesion, "where it is given [Pa]", Range::non_negative());

  file.add("Dilation", "from", windows.dilation_from, "the dilation rate is a slope from this axial compression",
           {.lowest = 0, .highest = 1, .highest_included = false});
  file.add("Dilation", "to", windows.dilation_to, "to this axial compression", Range::strictly_between(0, 1));

  file.add("Final state", "averaged strain", windows.final_average,
           "width in axial strain at the end of the shear over which the final state is averaged",
           {.lowest = 0, .highest = 1, .highest_included = false});

  file.add("Grains", "density", grain_density,
           "of the mineral; times the initial solid fraction it is the continuum's density [kg/m3]",
           Range::positive().usual(500, 2e4));

  file.add(
      "Hardening", "fit", hardening_is_wanted,
      "fit a continuum whose friction is mobilised by plastic strain to whole curves, from what the sections above "
      "tell");

  file.add("Sand", "fit", sand.is_wanted,
           "fit hypoplastic sand, too, to all densities and pressures together, which must be several");
  file.add("Sand", "loosest over critical", sand.loosest_over_critical,
           "e_i0 over e_c0, which these tests do not tell; 1.15 is usual, 1.2 for spheres", Range::between(1, 2));
  file.add("Sand", "densest void ratio", sand.densest_void_ratio, "e_d0, where it is known; 0: fitted",
           Range::non_negative());
  file.add("Sand", "compression from", sand.compression_from,
           "share of the confining pressure from which the isotropic compression counts",
           Range::strictly_between(0, 1));
}

Forecast FitParameters::forecast() const
{
  Forecast f;
  f.files = {{"fit, parameters of the continuum and curves", 1, 1e6}};
  f.unknown.emplace_back("the samples of " + ensemble + ", from which their number follows; a fit takes seconds" +
                         std::string(hardening_is_wanted || sand.is_wanted ? ", that of a law minutes" : "") +
                         ", and makes no step");
  f.add_own_files(1, 0);
  return f;
}

bool takes(const std::vector<double> &list, const double value)
{
  return list.empty() ||
         std::any_of(list.begin(), list.end(),
                     [&](const double listed) { return std::abs(listed - value) <= 1e-6 * std::abs(value); });
}

} // namespace bergamo::driver
