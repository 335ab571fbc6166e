#pragma once

#include "dem/core/types.h"
#include "dem/force/contact_parameters.h"
#include "dem/state/material.h"

#include <cstdint>

namespace bergamo::dem
{

/// Numbers of the materials that every simulation has; further ones follow.
inline constexpr std::int32_t grain_material = 0, wall_material = 1;

/// Physics and numerics of a simulation.
struct SimulationParameters
{
  SimulationParameters();

  MaterialTable materials;      ///< of grains, of walls, and further ones
  Vec3 gravity = Vec3::Zero();  ///< [m/s^2]
  double time_step = 2.5e-7;    ///< [s]
  double verlet_distance = 0.1; ///< over the mean bounding radius
  int sort_interval = 100;      ///< renewals of the neighbours between two sorts of the grains by place
  ContactParameters contact;

  Material &grain() { return materials[grain_material]; }
  Material &wall() { return materials[wall_material]; }
  const Material &grain() const { return materials[grain_material]; }
  const Material &wall() const { return materials[wall_material]; }
  SurfacePair &between_grains() { return materials.between(grain_material, grain_material); }
  SurfacePair &with_walls() { return materials.between(grain_material, wall_material); }
  const SurfacePair &between_grains() const { return materials.between(grain_material, grain_material); }
  const SurfacePair &with_walls() const { return materials.between(grain_material, wall_material); }

  /// The same damping at all contacts: share of critical damping, and A of the viscoelastic law beside it [s].
  void set_damping(double ratio, double relaxation_time = 0.);

  /// Throws ConfigError for a value out of its range.
  void validate() const;

  /// What change() may alter, and a snapshot therefore keeps.
  template <class Self, class Visit>
  static void visit_state(Self &self, Visit &visit)
  {
    visit("surface_pairs", self.materials.surface_pairs());
    visit("gravity", self.gravity);
    visit("time_step", self.time_step);
    visit("verlet_distance", self.verlet_distance);
    visit("sort_interval", self.sort_interval);
    visit("overlap_tolerance", self.contact.overlap_tolerance);
    visit("curvature_bound", self.contact.curvature_bound);
  }
};

} // namespace bergamo::dem
