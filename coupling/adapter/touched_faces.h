#pragma once

#include "coupling/adapter/body_mover.h"
#include "coupling/adapter/touched_body.h"
#include "fe_dealii/boundary/face_triangles.h"

namespace bergamo::coupling
{

/// Faces of a body as grains touch them where it is at present. @throws ConfigError for triangles that make no surface
/// @param faces of the body's boundary, or of a membrane: see fe::divide_faces() and fe::both_sides()
dem::Surface surface_of(const fe::MovingBody &body, const fe::FaceTriangles &faces);

/// A body that deforms, touched on its faces.
class TouchedFaces final : public TouchedBody
{
public:
  TouchedFaces(BodyMover &body, fe::FaceTriangles faces) : body_(body), faces_(std::move(faces)) {}

  const Mover &mover() const override { return body_; }
  std::size_t n_corners() const override { return faces_.corners.size(); }
  bool is_rigid() const override { return false; }
  void find_places(std::span<Vec3> place) const override;
  void add_forces(const dem::Surface &surface) override;
  double largest_square(const dem::Surface &surface, std::span<const ContactSpring> springs) const override;

private:
  BodyMover &body_;
  fe::FaceTriangles faces_;
};

} // namespace bergamo::coupling
