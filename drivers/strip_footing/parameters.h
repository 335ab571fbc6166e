#pragma once

#include "drivers/common/continuum_parameters.h"
#include "drivers/common/forecast/forecast.h"
#include "drivers/common/output_parameters.h"
#include "drivers/common/parameter_file.h"
#include "drivers/common/summary.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace bergamo::driver
{

/// Limit pressures in closed form [Pa]. Of sand, with the friction of its critical state and no dilation: what dense
/// ground exceeds and loose ground comes near at large settlements.
struct LimitPressure
{
  double davis;      ///< with the strength that the flow rule leaves, see davis_strength()
  double associated; ///< as if the dilation angle were the friction angle: the same there, an upper bound else

  /// @param bearing pressure that the run gave [Pa]
  void add_figures(Summary &summary, double bearing) const;
};

/// What holds the ground where it goes on beyond the mesh: its far side and its bottom.
enum class FarBoundaries
{
  held, ///< rollers at the side, a rough floor
  quiet ///< both let waves leave
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
  bool large_strain = false;         ///< see fe::Kinematics; of degree 1
  double gravity = 0;                ///< downwards [m/s²]
  double surcharge = 0;              ///< on the whole surface [Pa]
  double earth_pressure_at_rest = 1; ///< K0

  FarBoundaries far_boundaries = FarBoundaries::held;

  ContinuumParameters continuum;
  std::vector<double> layer_depths;            ///< where deeper layers begin, growing [m]
  std::array<ContinuumParameters, 3> deeper{}; ///< of these
  double damping = 5;                          ///< mass-proportional [1/s]

  double step_share = 0.9; ///< of the stable time step
  OutputParameters output;

  /// Binds every parameter to its name in the parameter file.
  void declare(ParameterFile &file);

  /// Throws ConfigError for values that do not go together, before any work.
  void validate() const;

  /// What a run will be, for --dry-run. Call after validate().
  Forecast forecast() const;
  bool needs_mpi() const { return true; } ///< its ground starts at rest

  /// Edge of an element [m]. The settlement falls from that of the last node held to nothing over the element beside
  /// the footing, so that half of that element counts as covered (as in Itasca's FLAC).
  double element_size() const { return 0.5 * width / (elements_across + 0.5); }
  double elements_along(const double length) const { return std::max(1., std::round(length / element_size())); } // [m]
  /// Where a deeper layer begins, at the next edge of elements; z upwards [m].
  double layer_top(const std::size_t layer) const
  {
    return -std::round(layer_depths[layer] / element_size()) * element_size();
  }
  double ramp_time() const { return ramp * loading_time; }                         ///< [s]
  double speed() const { return settlement / (loading_time - 0.5 * ramp_time()); } ///< after the ramp [m/s]
  double settlement_at(const double time) const                                    ///< [s] to [m]
  {
    return speed() * (time < ramp_time() ? 0.5 * time * time / ramp_time() : time - 0.5 * ramp_time());
  }
  LimitPressure limit_pressure() const; ///< from cohesion, surcharge and weight, see bearing_factors()
};

} // namespace bergamo::driver
