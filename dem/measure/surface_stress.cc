#include "dem/measure/surface_stress.h"

#include <cmath>
#include <utility>

namespace bergamo::dem
{
namespace
{

/// Angle of a face at one of its nodes [rad].
double corner_angle(const Surface &surface, const SurfaceTopology::Corner &corner)
{
  const Triangle &t = surface.topology.triangle[corner.face];
  const Vec3 &tip = surface.node[t[corner.place]];
  const Vec3 a = surface.node[t[(corner.place + 1) % 3]] - tip, b = surface.node[t[(corner.place + 2) % 3]] - tip;
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

/// Faces that share a feature, and how; the shares add up to 1.
std::vector<std::pair<std::int32_t, double>> faces_of(const Surface &surface, const FeatureOfSurface &f)
{
  if (f.feature == Feature::face)
    return {{f.number, 1.}};
  if (f.feature == Feature::edge)
  {
    const SurfaceTopology::Edge &e = surface.topology.edge[f.number];
    if (e.right == SurfaceTopology::none)
      return {{e.left, 1.}};
    return {{e.left, 0.5}, {e.right, 0.5}};
  }
  std::vector<std::pair<std::int32_t, double>> faces;
  double sum = 0.;
  for (const SurfaceTopology::Corner &corner : surface.topology.corners_of(f.number))
    sum += faces.emplace_back(corner.face, corner_angle(surface, corner)).second;
  for (auto &[face, share] : faces)
    share /= sum;
  return faces;
}

double area_of(const Surface &surface, const Triangle &t)
{
  return 0.5 * (surface.node[t[1]] - surface.node[t[0]]).cross(surface.node[t[2]] - surface.node[t[0]]).norm();
}

} // namespace

std::vector<SurfaceStress> surface_stress(const std::span<const Surface> surfaces,
                                          const std::span<const TouchingContact> contacts,
                                          const std::span<const double> friction_work)
{
  std::vector<SurfaceStress> stresses;
  std::vector<std::vector<Vec3>> tangential; // forces, by surface and triangle
  for (const Surface &surface : surfaces)
  {
    const std::size_t n = surface.topology.n_faces();
    stresses.push_back(
        {std::vector(n, 0.), std::vector(n, 0.), std::vector<Vec3>(n, Vec3::Zero()), std::vector(n, 0.)});
    tangential.emplace_back(n, Vec3::Zero());
  }
  for (const TouchingContact &contact : contacts)
  {
    if (contact.feature < 0)
      continue;
    const FeatureOfSurface f = feature_of(surfaces, contact.feature);
    SurfaceStress &stress = stresses[f.surface];
    for (const auto &[face, share] : faces_of(surfaces[f.surface], f))
    {
      const double weight = share * contact.state.weight;
      stress.pressure[face] += weight * contact.state.forces.normal;
      tangential[f.surface][face] -= weight * contact.state.forces.tangential;
      stress.traction[face] -= weight * contact.state.force();
    }
  }
  for (std::size_t feature = 0; feature < friction_work.size(); ++feature)
    if (friction_work[feature] != 0.)
    {
      const FeatureOfSurface f = feature_of(surfaces, static_cast<std::int32_t>(feature));
      for (const auto &[face, share] : faces_of(surfaces[f.surface], f))
        stresses[f.surface].friction_work[face] += share * friction_work[feature];
    }
  for (std::size_t s = 0; s < surfaces.size(); ++s)
    for (std::size_t t = 0; t < tangential[s].size(); ++t)
    {
      const double area = area_of(surfaces[s], surfaces[s].topology.triangle[t]);
      stresses[s].pressure[t] /= area;
      stresses[s].shear_stress[t] = tangential[s][t].norm() / area;
      stresses[s].traction[t] /= area;
      stresses[s].friction_work[t] /= area;
    }
  return stresses;
}

} // namespace bergamo::dem
