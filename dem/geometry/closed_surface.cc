#include "dem/geometry/closed_surface.h"

#include "dem/core/error.h"

#include <utility>
#include <vector>

namespace bergamo::dem
{

Holes holes_of(const SurfaceTopology &topology)
{
  Holes holes;
  std::vector<std::int32_t> next(topology.n_nodes(), SurfaceTopology::none); // along the rim: one fan has two ends
  for (std::size_t e = 0; e < topology.n_edges(); ++e)
  {
    const SurfaceTopology::Edge &edge = topology.edge[e];
    if (edge.right != SurfaceTopology::none)
      continue;
    if (holes.n_edges++ == 0)
      holes.edge = static_cast<std::int32_t>(e);
    next[edge.from] = edge.to;
  }
  for (std::size_t n = 0; n < next.size(); ++n)
  {
    if (next[n] == SurfaceTopology::none)
      continue;
    ++holes.n_holes;
    for (auto at = static_cast<std::int32_t>(n); at != SurfaceTopology::none;)
      at = std::exchange(next[at], SurfaceTopology::none);
  }
  return holes;
}

Moments enclosed_moments(const SurfaceView &surface, const Vec3 &origin)
{
  Moments sum = Moments::Zero();
  for (const Triangle &t : surface.topology.triangle)
  {
    const Vec3 a = surface.node[t[0]] - origin, b = surface.node[t[1]] - origin, c = surface.node[t[2]] - origin;
    const double volume = a.dot(b.cross(c)) / 6.;
    const Vec3 corners = a + b + c;
    const Mat3 second =
        (a * a.transpose() + b * b.transpose() + c * c.transpose() + corners * corners.transpose()) / 20.;
    Moments moments;
    moments << 1., corners / 4., second.diagonal(), second(0, 1), second(0, 2), second(1, 2);
    sum += volume * moments;
  }
  return sum;
}

EnclosedBody enclosed_body(const SurfaceView &surface)
{
  if (const Holes holes = holes_of(surface.topology); holes.n_edges > 0)
  {
    const SurfaceTopology::Edge &e = surface.topology.edge[holes.edge];
    reject("a surface has ", holes.n_holes, " holes of ", holes.n_edges, " edges, one from node ", e.from, " to node ",
           e.to, ": only a closed one has a mass; close it");
  }
  Vec3 middle = Vec3::Zero();
  for (const Vec3 &node : surface.node)
    middle += node / static_cast<double>(surface.node.size());
  const Moments moments = enclosed_moments(surface, middle);
  if (!(moments[0] > 0.))
    reject("a surface encloses ", moments[0],
           " m3: its normals point inwards, and a body's outwards; turn its triangles around");
  EnclosedBody body;
  body.volume = moments[0];
  const Vec3 arm = moments.segment<3>(1).matrix() / body.volume;
  body.centre = middle + arm;
  body.inertia = inertia_of(second_moments(moments) - body.volume * arm * arm.transpose());
  return body;
}

} // namespace bergamo::dem
