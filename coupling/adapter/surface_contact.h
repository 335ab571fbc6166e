#pragma once

#include "coupling/adapter/grains_mover.h"
#include "coupling/adapter/touched_faces.h"
#include "coupling/adapter/touched_rigid.h"
#include "coupling/model/coupling.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace bergamo::coupling
{

/// Contact of grains with a body that moves by itself, rigid or of elements: its surface is one of the simulation's,
/// follows the body, and what grains exert on it acts on the body. Forces and moments on both sides are the same to
/// rounding, and what one side loses in energy the other gains. Surfaces must not be removed from the simulation
/// meanwhile.
class SurfaceContact final : public Coupling
{
public:
  /// @param surface of the simulation, with the body's corners as its nodes in their order: see surface_of()
  /// @throws ConfigError for a surface that the simulation lacks or that has other nodes
  SurfaceContact(GrainsMover &grains, std::unique_ptr<TouchedBody> body, std::int32_t surface,
                 std::string name = "surface contact");
  SurfaceContact(GrainsMover &grains, RigidMover &body, std::int32_t surface, std::string name = "surface contact")
      : SurfaceContact(grains, std::make_unique<TouchedRigid>(body), surface, std::move(name))
  {
  }
  SurfaceContact(GrainsMover &grains, BodyMover &body, fe::FaceTriangles faces, std::int32_t surface,
                 std::string name = "surface contact")
      : SurfaceContact(grains, std::make_unique<TouchedFaces>(body, std::move(faces)), surface, std::move(name))
  {
  }

  void apply() override;
  void follow(double time_step) override;
  std::vector<const Mover *> movers() const override { return {&grains_, &body_->mover()}; }

  /// Of the contacts' stiffness against the masses of grains and body, their rotation included.
  double stable_step() override;

  std::int32_t surface() const { return surface_; } ///< of the simulation

private:
  GrainsMover &grains_;
  std::unique_ptr<TouchedBody> body_;
  std::int32_t surface_;
  std::vector<Vec3> place_; // of the corners, while they are taken over [m]
};

} // namespace bergamo::coupling
