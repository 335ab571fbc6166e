#pragma once

#include "dem/core/types.h"
#include "dem/motion/cell_control.h"

#include <array>

namespace bergamo::dem
{

/// How a periodic cell is loaded. The axis is z.
enum class LoadingPath
{
  isotropic,         ///< the same pressure on all axes
  triaxial,          ///< strained along z, the pressure across kept: compression or extension
  true_triaxial,     ///< a stress of its own on every axis
  constant_volume,   ///< strained along z, the volume kept
  constant_pressure, ///< strained along z, the mean pressure kept
};

/// One stage of a loading program. Stages under prescribed stresses alone (isotropic, true triaxial) end when the
/// stresses are reached and the grains rest; strained ones when their strain is.
struct LoadingStage
{
  LoadingPath path = LoadingPath::isotropic;
  double friction = 0.24;          ///< between grains during the stage
  double pressure = 25e3;          ///< see the path; it also sets the rate [Pa]
  Vec3 stresses = Vec3::Zero();    ///< of true triaxial loading, compression positive [Pa]
  double inertial_number = 1e-3;   ///< of the strain rate at that pressure (Wellmann 5.1.3)
  double axial_strain = -0.2;      ///< change of L_z over L_z at the start; negative is compression
  int n_cycles = 0;                ///< of the axial strain, to the one given, its opposite and back; 0 goes there once
  double time_step = 2.5e-7;       ///< at most [s]
  double overlap_tolerance = 3e-5; ///< see ContactParameters
  double stress_tolerance = 0.005; ///< over the pressure
  double force_tolerance = 0.01;   ///< mean unbalanced over mean contact force, see unbalanced_force()
  double longest_time = 1.;        ///< [s]

  /// Ends by its strain.
  bool is_strained() const { return path != LoadingPath::isotropic && path != LoadingPath::true_triaxial; }

  /// Throws ConfigError for a value out of its range.
  void validate() const;
};

/// Strain along z at which the n-th leg of a strained stage ends. @param leg in [0, n_legs())
double end_of_leg(const LoadingStage &stage, int leg);

/// Legs of the axial strain, each in one direction.
int n_legs(const LoadingStage &stage);

/// Length of the way that the axial strain goes over all legs.
double strain_path(const LoadingStage &stage);

/// What each axis is held to. @param mean_stress principal stresses, tension positive [Pa]
/// @param axial_rate of L_z over L_z, with its sign [1/s]
std::array<AxisControl, 3> controls_of(const LoadingStage &stage, const Vec3 &mean_stress, double axial_rate);

} // namespace bergamo::dem
