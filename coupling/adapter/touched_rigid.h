#pragma once

#include "coupling/adapter/rigid_mover.h"
#include "coupling/adapter/touched_body.h"

namespace bergamo::coupling
{

/// A rigid body's surface as grains touch it. @throws ConfigError for triangles that make no surface
dem::Surface surface_of(const fe::RigidBody &body);

/// A rigid body without a mesh, touched on its triangles.
class TouchedRigid final : public TouchedBody
{
public:
  explicit TouchedRigid(RigidMover &body) : body_(body) {}

  const Mover &mover() const override { return body_; }
  std::size_t n_corners() const override { return body_.body().n_vertices(); }
  bool is_rigid() const override { return true; }
  void find_places(std::span<Vec3> place) const override;
  void add_forces(const dem::Surface &surface) override;
  double largest_square(const dem::Surface &surface, std::span<const ContactSpring> springs) const override;

private:
  RigidMover &body_;
};

} // namespace bergamo::coupling
