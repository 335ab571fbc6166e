#include "drivers/common/grain_parameters.h"

namespace bergamo::driver
{

void declare_distribution(ParameterFile &file, const std::string &section, dem::GrainDistribution &distribution)
{
  file.add(section, "mean half-axes", {distribution.mean_half_axes.data(), 3}, "means of the three half-axes [m]",
           Range::positive().usual(1e-6, 0.1));
  file.add(section, "relative deviation", distribution.relative_deviation,
           "standard deviation of a half-axis over its mean", Range::between(0, 1));
  file.add(section, "smallest half-axis", distribution.smallest_half_axis, "[m]", Range::positive().usual(1e-6, 0.1));
  file.add(section, "largest half-axis", distribution.largest_half_axis, "[m]", Range::positive().usual(1e-6, 0.1));
  file.add(section, "smallest exponent", distribution.smallest_exponent,
           "of the uniform distribution; towards 0 a box, 1 an ellipsoid, towards 2 an octahedron",
           Range::strictly_between(0, 2));
  file.add(section, "largest exponent", distribution.largest_exponent, "of the uniform distribution",
           Range::strictly_between(0, 2));
}

void declare_grains(ParameterFile &file, dem::SimulationParameters &simulation)
{
  file.add("Grains", "Young's modulus", simulation.grain().young_modulus, "of the grains' mineral [Pa]",
           Range::positive().usual(1e6, 1e12));
  file.add("Grains", "Poisson's ratio", simulation.grain().poisson_ratio, "of the grains' mineral",
           {.lowest = 0, .highest = 0.5, .highest_included = false});
  file.add("Grains", "density", simulation.grain().density, "of the grains' mineral [kg/m3]",
           Range::positive().usual(500, 2e4));
  file.add("Grains", "damping ratio", simulation.between_grains().damping_ratio,
           "dashpot at the contacts, share of critical damping", Range::between(0, 10).usual(0, 1));
  file.add("Grains", "curvature bound", simulation.contact.curvature_bound,
           "k: radii of curvature at contacts lie in [k r_min, r_max / k], r the half-axes of the grain",
           {.lowest = 0, .highest = 1, .lowest_included = false});
  file.add("Grains", "Verlet distance", simulation.verlet_distance, "over the mean bounding radius",
           Range{.lowest = 0, .highest = 2, .lowest_included = false}.usual(0.01, 1));
}

void declare_overlap_tolerance(ParameterFile &file, const std::string &section, double &tolerance)
{
  file.add(section, "overlap tolerance", tolerance,
           "relative error of the overlap that may build up between two searches of a contact; 0 searches every step",
           Range::between(0, 0.1));
}

} // namespace bergamo::driver
