#pragma once

#include "coupling/adapter/arlequin_coupling.h"
#include "dem/packing/space.h"
#include "dem/simulation/simulation_parameters.h"
#include "drivers/common/continuum_parameters.h"
#include "drivers/common/forecast/forecast.h"
#include "drivers/common/intruder.h"
#include "drivers/common/output_parameters.h"
#include "drivers/common/parameter_file.h"
#include "drivers/common/sand_parameters.h"
#include "drivers/pile_installation/field_parameters.h"
#include "drivers/pile_installation/ground_plan.h"

#include <cstdint>

namespace bergamo::driver
{

enum class GroundKind
{
  two_scale,
  grains
};

enum class PileDrive
{
  speed,
  force
};

/// Everything that steers a pile that is pressed into sand. SI units; z = 0 at the bottom of the box of sand, the
/// pile's axis in its middle.
struct InstallationParameters
{
  InstallationParameters();

  GroundKind kind = GroundKind::two_scale;
  coupling::WeightShape weight = coupling::WeightShape::linear;

  double block_width = 34e-3, block_depth = 14e-3; ///< of the grains, to the outer edge of the overlap [m]
  double beyond_sides = 0., beyond_bottom = 0.;    ///< ground of elements beyond the box of sand [m]
  double growth_depth = 0.;                        ///< by which the block may become deeper [m]
  double growth_distance = 6e-3;                   ///< of the tip above the overlap that makes it so [m]
  GroundMesh mesh;
  bool bending_elements = false; ///< see fe::Hourglass
  bool large_strain = false;     ///< see fe::Kinematics

  IntruderShape pile; ///< of kind pile or cone; a pile's breadth is the box's, see shape()
  double pile_friction = 0.1;
  PileDrive drive = PileDrive::speed;
  double speed = 0.05;      ///< [m/s]
  double head_force = 0.1;  ///< at the end [N]
  double pile_mass = 1e-3;  ///< of a pile that a force drives [kg]
  double time = 0.15;       ///< of the installation [s]
  double start_time = 5e-3; ///< over which the speed grows [s]

  SandParameters sand;                  ///< settles under the gravity of the whole run
  dem::SimulationParameters simulation; ///< without the pile's material
  double settling_friction = 0.24;      ///< between grains
  unsigned int tiles = 0; ///< of which the sand is made up along x, copies of one; 0: it fills a box as a whole

  ContinuumParameters continuum;
  double continuum_damping = 20.; ///< mass-proportional [1/s]
  coupling::CouplingParameters coupling;
  FieldParameters fields;
  OutputParameters output;

  /// Binds every parameter to its name in the parameter file.
  void declare(ParameterFile &file);

  /// Throws ConfigError for values that do not go together, before any work.
  void validate() const;

  /// What a run will be, for --dry-run. Call after validate().
  Forecast forecast() const;

  /// Warnings of values that are unwise beside others.
  std::vector<std::string> advice() const;

  const char *model_name() const { return kind == GroundKind::grains ? "grains" : "two-scale"; }
  bool is_two_scale() const { return kind == GroundKind::two_scale; }
  bool needs_mpi() const { return is_two_scale(); } ///< to find the equilibrium it starts from

  dem::Box box() const;  ///< of the sand
  dem::Box tile() const; ///< of the sand that is packed and settled where it is one of several tiles, from x = 0
  double gravity() const { return sand.settling_gravity; }
  dem::SimulationParameters settling() const;
  dem::SimulationParameters installing() const; ///< with the pile's material, see intruder_material

  /// @param level of the settled sand, to which the elements reach: what they bore above it would weigh on the sand
  /// beside and below the pile, and hold it down [m]
  GroundPlan plan(double level) const;

  IntruderShape shape() const;
  Intruder make_pile(double height) const; ///< its lowest point at that height [m]

  double final_way() const { return drive == PileDrive::speed ? speed * (time - 0.5 * start_time) : 0.; } ///< [m]
  double speed_at(double time) const; ///< downwards [m/s]; time since the pile is there [s]
  double force_at(double time) const; ///< on the head, downwards [N]
  std::int64_t n_steps() const;
  /// How far about the block grains count as neighbours of those that it gets as it grows [m].
  double beside_block() const { return 4. * sand.distribution.largest_half_axis; }
  int n_growths() const; ///< of the block, by a layer of elements each
  double deepest_block() const { return block_depth + n_growths() * mesh.element_size; } ///< [m]

private:
  void validate_plan() const;
  void validate_tiles() const;
  void validate_pile() const;
};

} // namespace bergamo::driver
