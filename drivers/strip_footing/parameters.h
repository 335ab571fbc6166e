#pragma once

#include "drivers/common/output_parameters.h"
#include "drivers/common/parameter_file.h"
#include "fe_dealii/material/mohr_coulomb.h"

#include <algorithm>
#include <cmath>

namespace bergamo::driver
{

/// Limit pressures in closed form [Pa].
struct LimitPressure
{
  double davis;      ///< with the strength that the flow rule leaves, see davis_strength()
  double associated; ///< as if the dilation angle were the friction angle: the same there, an upper bound else
};

/// Everything that steers the footing. SI units; angles in degrees.
struct FootingParameters
{
  FootingParameters();

  double width = 1;         ///< B of the footing [m]
  bool rough = true;        ///< no slip under the footing
  double settlement = 0.03; ///< at the end [m]
  double loading_time = 3;  ///< [s]
  double ramp = 0.1;        ///< share of the time in which the footing speeds up

  double ground_width = 3;          ///< from the axis of symmetry [m]
  double ground_depth = 2;          ///< [m]
  unsigned int elements_across = 8; ///< under half of the footing
  unsigned int degree = 1;
  bool bending_elements = false;     ///< of degree 1
  double gravity = 0;                ///< downwards [m/s²]
  double surcharge = 0;              ///< on the whole surface [Pa]
  double earth_pressure_at_rest = 1; ///< K0

  fe::MohrCoulombParameters continuum;
  double damping = 5; ///< mass-proportional [1/s]

  double step_share = 0.9; ///< of the stable time step
  OutputParameters output;

  /// Binds every parameter to its name in the parameter file.
  void declare(ParameterFile &file);

  /// Throws ConfigError for values that do not go together, before any work.
  void validate() const;

  /// Edge of an element [m]. The settlement falls from that of the last node held to nothing over the element beside
  /// the footing, so that half of that element counts as covered (as in Itasca's FLAC).
  double element_size() const { return 0.5 * width / (elements_across + 0.5); }
  double elements_along(const double length) const { return std::max(1., std::round(length / element_size())); } // [m]
  double ramp_time() const { return ramp * loading_time; }                         ///< [s]
  double speed() const { return settlement / (loading_time - 0.5 * ramp_time()); } ///< after the ramp [m/s]
  double settlement_at(const double time) const                                    ///< [s] to [m]
  {
    return speed() * (time < ramp_time() ? 0.5 * time * time / ramp_time() : time - 0.5 * ramp_time());
  }
  LimitPressure limit_pressure() const; ///< from cohesion, surcharge and weight, see bearing_factors()
};

} // namespace bergamo::driver
