#include "coupling/adapter/surface_contact.h"

#include "dem/core/error.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>

namespace bergamo::coupling
{
namespace
{

Vec3 vector(const fe::RigidBody::Vector &v)
{
  return {v[0], v[1], v[2]};
}

std::vector<Vec3> vertices_of(const fe::RigidBody &body)
{
  std::vector<Vec3> places;
  for (std::size_t k = 0; k < body.n_vertices(); ++k)
    places.push_back(vector(body.vertex(k)));
  return places;
}

/// Bounds a contact's stiffness in any direction [N/m].
double stiffness_of(const dem::ContactView &contact)
{
  const double root = std::sqrt(contact.overlap);
  return std::abs(contact.weight) * root * std::max(1.5 * contact.stiffness.normal, contact.stiffness.tangential_major);
}

} // namespace

dem::Surface surface_of(const fe::RigidBody &body)
{
  std::vector<dem::Triangle> triangles;
  for (const auto &[a, b, c] : body.triangles())
    triangles.push_back({static_cast<std::int32_t>(a), static_cast<std::int32_t>(b), static_cast<std::int32_t>(c)});
  return {vertices_of(body), std::move(triangles)};
}

SurfaceContact::SurfaceContact(GrainsMover &grains, RigidMover &body, const std::int32_t surface, std::string name)
    : Coupling(std::move(name)), grains_(grains), body_(body), surface_(surface)
{
  std::vector<dem::Surface> &surfaces = grains.simulation().surfaces;
  require(surface >= 0 && surface < static_cast<std::int32_t>(surfaces.size()),
          "number of the surface of '" + body.name() + "'", surface,
          "that of one of the " + std::to_string(surfaces.size()) + " surfaces of the grains, counted from 0");
  dem::Surface &own = surfaces[surface];
  require(own.node.size() == body.body().n_vertices(), "number of nodes of the surface of '" + body.name() + "'",
          own.node.size(), "that of the body's vertices, " + std::to_string(body.body().n_vertices()));
  own.is_rigid = true;
  own.velocity.assign(own.node.size(), Vec3::Zero()); // the nodes are moved by follow()
  if (own.force.empty())
    own.force = grains.simulation().node_forces(surface); // forces of this step may be known already
  grains.share_surface(surface);
}

void SurfaceContact::apply()
{
  const dem::Surface &surface = grains_.simulation().surfaces[surface_];
  for (std::size_t n = 0; n < surface.node.size(); ++n)
  {
    const Vec3 &f = surface.force[n], &x = surface.node[n];
    if (!f.isZero(0.))
      body_.body().add_force({f[0], f[1], f[2]}, {x[0], x[1], x[2]});
  }
}

void SurfaceContact::follow(const double time_step)
{
  grains_.simulation().surfaces[surface_].move_to(vertices_of(body_.body()), time_step);
}

/// The grains' own step has their contacts with walls of any mass. As k (a - b)^2 is at most 2 k a^2 + 2 k b^2, the
/// coupling adds the same once more for them, and twice that of the body.
double SurfaceContact::stable_step()
{
  const dem::Simulation &grains = grains_.simulation();
  const dem::Particles &p = grains.particles;
  const fe::RigidInertia &inertia = body_.body().inertia();
  const Mat3 tensor = Eigen::Map<const Mat3>(&inertia.inertia[0][0]);
  const double least_inertia = Eigen::SelfAdjointEigenSolver<Mat3>(tensor, Eigen::EigenvaluesOnly).eigenvalues()[0];
  const Vec3 centre = vector(body_.body().centre());
  double of_body = 0.;
  std::unordered_map<std::int32_t, double> of_grain; // square of a frequency
  for (const dem::TouchingContact &contact : grains.contacts.touching_walls(p))
  {
    if (contact.feature < 0 || dem::feature_of(grains.surfaces, contact.feature).surface != surface_)
      continue;
    const double stiffness = stiffness_of(contact.state);
    const auto square = [&](const double mass, const double least_moment, const Vec3 &arm) {
      return stiffness * ((mass > 0. ? 1. / mass : 0.) + (least_moment > 0. ? arm.squaredNorm() / least_moment : 0.));
    };
    const std::int32_t i = contact.first;
    of_grain[i] += square(p.mass[i], p.inertia[i].minCoeff(), contact.state.point);
    of_body += square(inertia.mass, least_inertia, p.position[i] + contact.state.point - centre);
  }
  double most = 2. * of_body;
  for (const auto &[grain, square] : of_grain)
    most = std::max(most, square);
  return most > 0. ? 2. / std::sqrt(most) : std::numeric_limits<double>::infinity();
}

} // namespace bergamo::coupling
