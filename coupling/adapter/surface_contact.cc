#include "coupling/adapter/surface_contact.h"

#include "dem/core/error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>

namespace bergamo::coupling
{
namespace
{

/// Bounds a contact's stiffness in any direction [N/m].
double stiffness_of(const dem::ContactView &contact)
{
  const double root = std::sqrt(contact.overlap);
  return std::abs(contact.weight) * root * std::max(1.5 * contact.stiffness.normal, contact.stiffness.tangential_major);
}

} // namespace

SurfaceContact::SurfaceContact(GrainsMover &grains, std::unique_ptr<TouchedBody> body, const std::int32_t surface,
                               std::string name)
    : Coupling(std::move(name)), grains_(grains), body_(std::move(body)), surface_(surface), place_(body_->n_corners())
{
  std::vector<dem::Surface> &surfaces = grains.simulation().surfaces;
  const std::string &owner = body_->mover().name();
  require(surface >= 0 && surface < static_cast<std::int32_t>(surfaces.size()),
          "number of the surface of '" + owner + "'", surface,
          "that of one of the " + std::to_string(surfaces.size()) + " surfaces of the grains, counted from 0");
  dem::Surface &own = surfaces[surface];
  require(own.node.size() == place_.size(), "number of nodes of the surface of '" + owner + "'", own.node.size(),
          "that of the body's corners, " + std::to_string(place_.size()));
  own.is_rigid = body_->is_rigid();
  own.velocity.assign(own.node.size(), Vec3::Zero()); // the nodes are moved by follow()
  if (own.force.empty())
    own.force = grains.simulation().node_forces(surface); // forces of this step may be known already
  grains.share_surface(surface);
}

void SurfaceContact::apply()
{
  body_->add_forces(grains_.simulation().surfaces[surface_]);
}

void SurfaceContact::follow(const double time_step)
{
  body_->find_places(place_);
  grains_.simulation().surfaces[surface_].move_to(place_, time_step);
}

/// The grains' own step has their contacts with walls of any mass. As k (a - b)^2 is at most 2 k a^2 + 2 k b^2, the
/// coupling adds the same once more for them, and twice that of the body.
double SurfaceContact::stable_step()
{
  const dem::Simulation &grains = grains_.simulation();
  const dem::Particles &p = grains.particles;
  std::vector<ContactSpring> springs;
  std::unordered_map<std::int32_t, double> of_grain; // square of a frequency
  for (const dem::TouchingContact &contact : grains.contacts.touching_walls(p))
  {
    if (contact.feature < 0)
      continue;
    const dem::FeatureOfSurface feature = dem::feature_of(grains.surfaces, contact.feature);
    if (feature.surface != surface_)
      continue;
    const double stiffness = stiffness_of(contact.state);
    const std::int32_t i = contact.first;
    const Vec3 &arm = contact.state.point;
    springs.push_back({feature, p.position[i] + arm, stiffness});
    of_grain[i] += stiffness * (1. / p.mass[i] + arm.squaredNorm() / p.inertia[i].minCoeff());
  }
  double most = 2. * body_->largest_square(grains.surfaces[surface_], springs);
  for (const auto &[grain, square] : of_grain)
    most = std::max(most, square);
  return most > 0. ? 2. / std::sqrt(most) : std::numeric_limits<double>::infinity();
}

} // namespace bergamo::coupling
