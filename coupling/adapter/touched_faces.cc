#include "coupling/adapter/touched_faces.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <unordered_map>
#include <vector>

namespace bergamo::coupling
{
namespace
{

void find_corners(const fe::MovingBody &body, const fe::FaceTriangles &faces, const std::span<Vec3> place)
{
  const auto &reference = body.node_position();
  const std::span<const double> displacement = body.displacement();
  for (std::size_t corner = 0; corner < place.size(); ++corner)
  {
    Vec3 sum = Vec3::Zero();
    for (const auto &[node, value] : faces.corners[corner])
      sum += value * (Eigen::Map<const Vec3>(reference[node].data()) +
                      Eigen::Map<const Vec3>(&displacement[3 * std::size_t(node)]));
    place[corner] = sum;
  }
}

} // namespace

dem::Surface surface_of(const fe::MovingBody &body, const fe::FaceTriangles &faces)
{
  std::vector<Vec3> corners(faces.corners.size());
  find_corners(body, faces, corners);
  std::vector<dem::Triangle> triangles;
  for (const auto &[a, b, c] : faces.triangles)
    triangles.push_back({static_cast<std::int32_t>(a), static_cast<std::int32_t>(b), static_cast<std::int32_t>(c)});
  return {std::move(corners), std::move(triangles)};
}

void TouchedFaces::find_places(const std::span<Vec3> place) const
{
  find_corners(body_.body(), faces_, place);
}

void TouchedFaces::add_forces(const dem::Surface &surface)
{
  const std::span<double> external = body_.body().external_force();
  for (std::size_t corner = 0; corner < surface.force.size(); ++corner)
    if (const Vec3 &force = surface.force[corner]; !force.isZero(0.))
      for (const auto &[node, value] : faces_.corners[corner])
        Eigen::Map<Vec3>(&external[3 * std::size_t(node)]) += value * force;
}

/// A spring k acts on the displacement Σ N_i u_i; no eigenvalue of M⁻¹ Σ k N Nᵀ is greater than the greatest sum of a
/// row's absolute values (Gershgorin).
double TouchedFaces::largest_square(const dem::Surface &surface, const std::span<const ContactSpring> springs) const
{
  std::unordered_map<unsigned int, double> sum_of_row; // times the mass [N/m]
  for (const ContactSpring &spring : springs)
  {
    const dem::NodeShares of_corners =
        dem::node_shares(surface, spring.feature.feature, spring.feature.number, spring.point);
    std::map<unsigned int, double> of_node;
    for (int k = 0; k < 3; ++k)
      for (const auto &[node, value] : faces_.corners[of_corners.node[k]])
        of_node[node] += of_corners.share[k] * value;
    double whole = 0.;
    for (const auto &[node, share] : of_node)
      whole += std::abs(share);
    for (const auto &[node, share] : of_node)
      sum_of_row[node] += spring.stiffness * std::abs(share) * whole;
  }
  double largest = 0.;
  for (const auto &[node, sum] : sum_of_row)
    largest = std::max(largest, sum / body_.body().mass()[3 * std::size_t(node)]);
  return largest;
}

} // namespace bergamo::coupling
