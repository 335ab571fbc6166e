#include "dem/loading/loading_stage.h"

#include "dem/core/error.h"

#include <cmath>

namespace bergamo::dem
{

void LoadingStage::validate() const
{
  require(friction >= 0. && std::isfinite(friction), "friction of the stage", friction, "at least 0");
  require(pressure > 0. && std::isfinite(pressure), "pressure of the stage", pressure, "positive [Pa]");
  if (path == LoadingPath::true_triaxial)
    for (int d = 0; d < 3; ++d)
      require(stresses[d] > 0. && std::isfinite(stresses[d]), "stress of true triaxial loading", stresses[d],
              "positive in compression [Pa]: grains bear no tension");
  require(inertial_number > 0. && inertial_number <= 0.1, "inertial number", inertial_number,
          "in (0, 0.1]: above, the flow is not quasi-static by far");
  if (is_strained())
    require(axial_strain != 0. && axial_strain > -0.7 && axial_strain < 2., "axial strain", axial_strain,
            "in (-0.7, 2) and not 0");
  require(n_cycles >= 0 && n_cycles <= 1000000, "number of cycles", n_cycles, "in [0, 1000000]");
  require(n_cycles == 0 || std::abs(axial_strain) < 0.5, "axial strain of a cycle", axial_strain, "in (-0.5, 0.5)");
  require(time_step > 0. && std::isfinite(time_step), "time step", time_step, "positive [s]");
  require(overlap_tolerance >= 0. && overlap_tolerance <= 0.1, "overlap tolerance", overlap_tolerance, "in [0, 0.1]");
  require(stress_tolerance > 0. && stress_tolerance < 1., "stress tolerance", stress_tolerance, "in (0, 1)");
  require(force_tolerance > 0. && force_tolerance < 1., "force tolerance", force_tolerance, "in (0, 1)");
  require(longest_time > 0. && std::isfinite(longest_time), "longest time of the stage", longest_time, "positive [s]");
}

int n_legs(const LoadingStage &stage)
{
  return stage.n_cycles == 0 ? 1 : 2 * stage.n_cycles + 1;
}

double end_of_leg(const LoadingStage &stage, const int leg)
{
  if (stage.n_cycles > 0 && leg == n_legs(stage) - 1)
    return 0.;
  return leg % 2 == 0 ? stage.axial_strain : -stage.axial_strain;
}

double strain_path(const LoadingStage &stage)
{
  double path = 0.;
  for (int leg = 0; leg < n_legs(stage); ++leg)
    path += std::abs(end_of_leg(stage, leg) - (leg == 0 ? 0. : end_of_leg(stage, leg - 1)));
  return path;
}

std::array<AxisControl, 3> controls_of(const LoadingStage &stage, const Vec3 &mean_stress, const double axial_rate)
{
  const auto axial = AxisControl::of_rate(axial_rate);
  const auto across = [&](const AxisControl &control) { return std::array{control, control, axial}; };
  switch (stage.path)
  {
  case LoadingPath::triaxial:
    return across(AxisControl::of_stress(-stage.pressure));
  case LoadingPath::constant_volume:
    return across(AxisControl::of_rate(-0.5 * axial_rate));
  case LoadingPath::constant_pressure:
    return across(AxisControl::of_stress(0.5 * (-3. * stage.pressure - mean_stress[2])));
  case LoadingPath::true_triaxial:
    return {AxisControl::of_stress(-stage.stresses[0]), AxisControl::of_stress(-stage.stresses[1]),
            AxisControl::of_stress(-stage.stresses[2])};
  case LoadingPath::isotropic:
    break;
  }
  const auto held = AxisControl::of_stress(-stage.pressure);
  return {held, held, held};
}

} // namespace bergamo::dem
