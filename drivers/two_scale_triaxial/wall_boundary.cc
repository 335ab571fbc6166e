#include "drivers/two_scale_triaxial/specimen_boundary.h"

#include <array>
#include <optional>

namespace bergamo::driver
{
namespace
{

class WallBoundary final : public SpecimenBoundary
{
public:
  WallBoundary(coupling::TwoScaleModel &models, const bool is_joined) : model(models)
  {
    if (fe::ExplicitBody *body = model.body())
      for (unsigned int face = 0; face < (is_joined ? 5u : 6u); ++face)
        faces[face].constraint = body->prescribe_velocity(face, face / 2);
    if (!model.grains())
      return;
    std::size_t wall = 0; // joined, the grains' floor is gone and the wall above has moved up in the list
    for (std::size_t face = 0; face < 6; ++face)
      if (face != 4 || !is_joined)
        faces[face].wall = wall++;
  }

  void move(const Vec3 &velocity) override
  {
    for (int d = 0; d < 3; ++d)
    {
      const Face &face = faces[2 * d + 1];
      if (face.wall)
        model.grains()->walls[*face.wall].velocity = velocity[d] * Vec3::Unit(d);
      if (face.constraint)
        model.body()->set_velocity(*face.constraint, velocity[d]);
    }
  }

  Vec3 stress(const Vec3 &edges, const SpecimenSample &) const override
  {
    Vec3 stress = Vec3::Zero();
    for (int d = 0; d < 3; ++d)
    {
      const double area = edges.prod() / edges[d];
      int n_faces = 0;
      for (int side = 0; side < 2; ++side)
      {
        const Face &face = faces[2 * d + side];
        if (!face.wall && !face.constraint)
          continue;
        double pull = 0.; // force of the surroundings on the specimen, outwards
        const double outwards = side == 0 ? -1. : 1.;
        if (face.wall)
          pull -= outwards * model.grains()->walls[*face.wall].force[d];
        if (face.constraint)
          pull += outwards * model.continuum()->reaction(*face.constraint);
        stress[d] += pull / area;
        ++n_faces;
      }
      stress[d] /= n_faces;
    }
    return stress;
  }

private:
  struct Face
  {
    std::optional<std::size_t> wall;                        // of the grains
    std::optional<fe::ExplicitBody::Constraint> constraint; // of the continuum
  };

  coupling::TwoScaleModel &model;
  std::array<Face, 6> faces; // x-, x+, y-, y+, z-, z+
};

} // namespace

std::unique_ptr<SpecimenBoundary> between_walls(coupling::TwoScaleModel &model, const bool is_joined)
{
  return std::make_unique<WallBoundary>(model, is_joined);
}

} // namespace bergamo::driver
