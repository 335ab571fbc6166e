#include "dem/loading/strain_program.h"

#include "dem/core/error.h"

#include <algorithm>
#include <cmath>

namespace bergamo::dem
{
namespace
{

/// Share of a phase done at a share tau of its time: parabola, line, parabola.
double progress(const double tau, const double ramp)
{
  if (tau <= 0.)
    return 0.;
  if (tau >= 1.)
    return 1.;
  const double speed = 1. / (1. - ramp);
  if (tau < ramp)
    return 0.5 * speed * tau * tau / ramp;
  if (tau > 1. - ramp)
    return 1. - 0.5 * speed * (1. - tau) * (1. - tau) / ramp;
  return speed * (tau - 0.5 * ramp);
}

} // namespace

void StrainProgram::validate() const
{
  require(std::abs(isotropic_volumetric_strain) <= 0.1, "isotropic volumetric strain", isotropic_volumetric_strain,
          "in [-0.1, 0.1]: the continuum is a small-strain model");
  require(std::abs(axial_strain) <= 0.1, "axial strain", axial_strain,
          "in [-0.1, 0.1]: the continuum is a small-strain model");
  require(volumetric_strain_change >= 0. && volumetric_strain_change <= 0.1, "volumetric strain change",
          volumetric_strain_change, "in [0, 0.1]");
  require(isotropic_time > 0. && std::isfinite(isotropic_time), "isotropic time", isotropic_time, "positive [s]");
  require(shear_time > 0. && std::isfinite(shear_time), "shear time", shear_time, "positive [s]");
  require(ramp > 0. && ramp <= 0.5, "ramp", ramp, "in (0, 0.5]");
}

Vec3 StrainProgram::strain(const double time) const
{
  const double first = progress(time / isotropic_time, ramp);
  const double second = progress((time - isotropic_time) / shear_time, ramp);
  double volumetric = 0.;
  if (path == StrainPath::unloading)
    volumetric = volumetric_strain_change;
  else if (path == StrainPath::compression)
    volumetric = -volumetric_strain_change;
  const double lateral = 0.5 * (volumetric - axial_strain);
  Vec3 shear = Vec3::Constant(lateral);
  shear[static_cast<int>(axis)] = axial_strain;
  return first * Vec3::Constant(isotropic_volumetric_strain / 3.) + second * shear;
}

} // namespace bergamo::dem
