#pragma once

#include "coupling/adapter/grains_mover.h"
#include "coupling/adapter/rigid_mover.h"
#include "coupling/model/coupling.h"

#include <cstdint>

namespace bergamo::coupling
{

/// A rigid body's surface as grains touch it. @throws ConfigError for triangles that make no surface
dem::Surface surface_of(const fe::RigidBody &body);

/// Contact of grains with a rigid body that moves by itself: the body's surface is one of the simulation's, follows the
/// body, and what grains exert on it acts on the body. Forces and moments on both sides are the same to rounding, and
/// what one side loses in energy the other gains. Surfaces must not be removed from the simulation meanwhile.
class SurfaceContact final : public Coupling
{
public:
  /// @param surface of the simulation, with the body's vertices as its nodes in their order: see surface_of()
  /// @throws ConfigError for a surface that the simulation lacks or that has other nodes
  SurfaceContact(GrainsMover &grains, RigidMover &body, std::int32_t surface, std::string name = "surface contact");

  void apply() override;
  void follow(double time_step) override;
  std::vector<const Mover *> movers() const override { return {&grains_, &body_}; }

  /// Of the contacts' stiffness against the masses of grains and body, the body's rotation included.
  double stable_step() override;

  std::int32_t surface() const { return surface_; } ///< of the simulation

private:
  GrainsMover &grains_;
  RigidMover &body_;
  std::int32_t surface_;
};

} // namespace bergamo::coupling
