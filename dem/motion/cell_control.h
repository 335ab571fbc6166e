#pragma once

#include "dem/state/periodic_cell.h"

#include <array>

namespace bergamo::dem
{

/// What is prescribed along one axis of a periodic cell.
struct AxisControl
{
  enum class Kind
  {
    rate,  ///< logarithmic strain rate (dL/dt) / L [1/s]
    stress ///< principal stress, tension positive [Pa]
  };
  Kind kind = Kind::rate;
  double value = 0.;

  static AxisControl of_rate(const double rate) { return {Kind::rate, rate}; }
  static AxisControl of_stress(const double stress) { return {Kind::stress, stress}; }
};

/// How the edges follow the stress: each one carries walls of a mass on a damper (Wellmann 5.7-5.10), and the stress
/// applied to them approaches what is prescribed at the rate that strains of `largest_rate` would cause. Near it, the
/// applied stress is corrected until the mean stress of the grains is what is prescribed, also while the walls move
/// steadily against their dampers.
struct CellControlParameters
{
  double wall_density = 2650.;  ///< [kg/m^3]
  double wall_thickness = 3e-5; ///< t_w [m]
  double damping_ratio = 0.5;   ///< zeta; 1 is critical for the modulus below
  double modulus = 1e8;         ///< E, about the cell's stiffness [Pa]
  double largest_rate = 10.;    ///< of the strain along an axis whose stress is prescribed [1/s]

  /// Throws ConfigError for a value out of its range.
  void validate() const;

  /// Longest time step for which the walls on springs of the modulus are stable, for edges of that length [s].
  double stable_time_step(double shortest_edge) const;
};

/// Controls each axis of a periodic cell by its strain rate or its stress; both may change at any step.
class CellControl
{
public:
  explicit CellControl(const CellControlParameters &parameters);

  /// Sets cell.acceleration for the step to come.
  /// @param mean_stress principal stresses of the grains in the cell, tension positive [Pa]; @param time_step over
  /// which the acceleration will act, the kick [s]
  void act(PeriodicCell &cell, const std::array<AxisControl, 3> &controls, const Vec3 &mean_stress, double time_step);

  /// Has the applied stress start from the present one: to be called when an axis comes under another control.
  void start_from(const Vec3 &mean_stress) { applied = mean_stress; }

  CellControlParameters parameters;
  Vec3 applied = Vec3::Zero(); ///< stress on the walls [Pa]
};

} // namespace bergamo::dem
