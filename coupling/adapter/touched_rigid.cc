#include "coupling/adapter/touched_rigid.h"

#include <Eigen/Eigenvalues>

#include <vector>

namespace bergamo::coupling
{
namespace
{

Vec3 vector(const fe::RigidBody::Vector &v)
{
  return {v[0], v[1], v[2]};
}

void find_vertices(const fe::RigidBody &body, const std::span<Vec3> place)
{
  for (std::size_t k = 0; k < place.size(); ++k)
    place[k] = vector(body.vertex(k));
}

} // namespace

dem::Surface surface_of(const fe::RigidBody &body)
{
  std::vector<Vec3> vertices(body.n_vertices());
  find_vertices(body, vertices);
  std::vector<dem::Triangle> triangles;
  for (const auto &[a, b, c] : body.triangles())
    triangles.push_back({static_cast<std::int32_t>(a), static_cast<std::int32_t>(b), static_cast<std::int32_t>(c)});
  return {std::move(vertices), std::move(triangles)};
}

void TouchedRigid::find_places(const std::span<Vec3> place) const
{
  find_vertices(body_.body(), place);
}

void TouchedRigid::add_forces(const dem::Surface &surface)
{
  for (std::size_t n = 0; n < surface.node.size(); ++n)
  {
    const Vec3 &f = surface.force[n], &x = surface.node[n];
    if (!f.isZero(0.))
      body_.body().add_force({f[0], f[1], f[2]}, {x[0], x[1], x[2]});
  }
}

double TouchedRigid::largest_square(const dem::Surface &, const std::span<const ContactSpring> springs) const
{
  const fe::RigidInertia &inertia = body_.body().inertia();
  const Mat3 tensor = Eigen::Map<const Mat3>(&inertia.inertia[0][0]);
  const double least_inertia = Eigen::SelfAdjointEigenSolver<Mat3>(tensor, Eigen::EigenvaluesOnly).eigenvalues()[0];
  const Vec3 centre = vector(body_.body().centre());
  const double per_mass = inertia.mass > 0. ? 1. / inertia.mass : 0.; // guides may move what has none
  const double per_inertia = least_inertia > 0. ? 1. / least_inertia : 0.;
  double sum = 0.;
  for (const ContactSpring &spring : springs)
    sum += spring.stiffness * (per_mass + (spring.point - centre).squaredNorm() * per_inertia);
  return sum;
}

} // namespace bergamo::coupling
