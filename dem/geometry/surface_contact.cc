#include "dem/geometry/surface_contact.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace bergamo::dem
{
namespace
{

/// Where a body is deepest beneath a plane or at an edge.
struct Foot
{
  Vec3 normal;
  Vec3 arm;       ///< deepest point minus the body's centre [m]
  double overlap; ///< [m]
};

/// The features of one surface as one body sees them, each looked at once.
class SurfaceLook
{
public:
  SurfaceLook(const BodyPose &body, const SurfaceView &surface) : body(body), surface(surface) {}

  const Foot &face(std::int32_t f);
  const Foot &edge(std::int32_t e);
  Foot vertex(std::int32_t node);

  /// Whether the deepest point against a face lies on the face's side of its edge.
  bool is_inside(std::int32_t f, std::int32_t e);

  /// Index of the place on the line of an edge: places on both faces count, as they would on infinite ones.
  int index_of_line(std::int32_t e)
  {
    const SurfaceTopology::Edge &between = surface.topology.edge[e];
    const bool has_right = between.right != SurfaceTopology::none;
    return 1 - is_inside(between.left, e) - (has_right && is_inside(between.right, e));
  }

  /// Whether the place on the line of an edge lies on the edge's side of one of its nodes.
  bool is_beyond(std::int32_t e, std::int32_t node);

  int index_of_face(const std::int32_t f)
  {
    const auto &edges = surface.topology.edge_of[f];
    return std::all_of(edges.begin(), edges.end(), [&](const std::int32_t e) { return is_inside(f, e); });
  }

  int index_of_edge(const std::int32_t e)
  {
    const int index = index_of_line(e);
    const SurfaceTopology::Edge &ends = surface.topology.edge[e];
    return index != 0 && is_beyond(e, ends.from) && is_beyond(e, ends.to) ? index : 0;
  }

  /// What the sectors and rays of the infinite fan leave of its one place.
  int index_of_vertex(const std::int32_t node)
  {
    const SurfaceTopology &t = surface.topology;
    int index = 1;
    for (const auto &[f, place] : t.corners_of(node))
      index -= is_inside(f, t.edge_of[f][place]) && is_inside(f, t.edge_of[f][(place + 2) % 3]);
    for (const std::int32_t e : t.edges_of(node))
      if (const int of_line = index_of_line(e); of_line != 0 && is_beyond(e, node))
        index -= of_line;
    return index;
  }

  bool is_in_front(const Foot &foot, const Vec3 &point) const { return foot.normal.dot(body.position - point) > 0.; }

private:
  Foot foot_against(const Vec3 &normal, const Vec3 &point) const
  {
    const PlacedSupport<double> s = support(body, -normal);
    return {normal, s.arm, s.height - normal.dot(body.position - point)};
  }

  Vec3 direction(const SurfaceTopology::Edge &e) const
  {
    return (surface.node[e.to] - surface.node[e.from]).normalized();
  }

  const BodyPose &body;
  const SurfaceView &surface;
  std::map<std::int32_t, Foot> faces, edges;
};

const Foot &SurfaceLook::face(const std::int32_t f)
{
  if (const auto known = faces.find(f); known != faces.end())
    return known->second;
  const Triangle &t = surface.topology.triangle[f];
  const Vec3 &a = surface.node[t[0]];
  const Vec3 normal = (surface.node[t[1]] - a).cross(surface.node[t[2]] - a).normalized();
  return faces.emplace(f, foot_against(normal, a)).first->second;
}

bool SurfaceLook::is_inside(const std::int32_t f, const std::int32_t e)
{
  const SurfaceTopology::Edge &between = surface.topology.edge[e];
  const Foot &foot = face(f);
  const Vec3 along = surface.node[between.to] - surface.node[between.from]; // the same for both faces
  const double side = foot.normal.cross(along).dot(body.position + foot.arm - surface.node[between.from]);
  return between.left == f ? side >= 0. : side < 0.;
}

bool SurfaceLook::is_beyond(const std::int32_t e, const std::int32_t node)
{
  const SurfaceTopology::Edge &ends = surface.topology.edge[e];
  const Vec3 point = body.position + edge(e).arm, along = surface.node[ends.to] - surface.node[ends.from];
  return node == ends.from ? along.dot(point - surface.node[node]) > 0. : along.dot(point - surface.node[node]) <= 0.;
}

/// The normal turns from one face's to the other's until the deepest point lies straight above the edge: the slope
/// changes its sign between, so the angle is found for any body by steps of Newton kept within the bracket.
const Foot &SurfaceLook::edge(const std::int32_t e)
{
  if (const auto known = edges.find(e); known != edges.end())
    return known->second;
  const SurfaceTopology::Edge &ends = surface.topology.edge[e];
  const Vec3 &point = surface.node[ends.from];
  const Vec3 along = direction(ends), first = face(ends.left).normal, across = first.cross(along);
  // `across` points into the left face; the normal goes from `first` towards minus it where the edge is convex.
  const double end = ends.right == SurfaceTopology::none
                         ? M_PI
                         : std::atan2(-across.dot(face(ends.right).normal), first.dot(face(ends.right).normal));
  double low = std::min(0., end), high = std::max(0., end), angle = 0.5 * (low + high);
  Foot foot{};
  double last = std::numeric_limits<double>::infinity(); // slope; where Newton's steps do not halve it, the bracket is
  constexpr int most = 100;                              // halvings from pi to the resolution are 60
  for (int n = 0; n < most; ++n)
  {
    const Vec3 normal = first * std::cos(angle) - across * std::sin(angle);
    const Vec3 turned = -first * std::sin(angle) - across * std::cos(angle); // d normal / d angle
    TangentFrame frame;
    frame << turned, along;
    const PlacedSupport<double> s = support(body, Vec3(-normal), frame);
    foot = {normal, s.arm, s.height - normal.dot(body.position - point)};
    const double slope = -turned.dot(body.position + s.arm - point); // of the overlap
    const double curvature = s.radii.r11 - foot.overlap;
    (slope > 0. ? high : low) = angle;
    const double newton = angle - slope / curvature;
    const bool gets_on = std::abs(slope) < 0.5 * last && curvature > 0. && newton > low && newton < high;
    const double next = gets_on ? newton : 0.5 * (low + high);
    if (slope == 0. || std::abs(next - angle) < 1e-15)
      break;
    last = std::abs(slope);
    angle = next;
  }
  return edges.emplace(e, foot).first->second;
}

/// Newton on the sphere for the direction in which the body is least deep at the node, with steps that never raise it.
Foot SurfaceLook::vertex(const std::int32_t node)
{
  const Vec3 &point = surface.node[node];
  const Vec3 line = body.position - point;
  Vec3 normal = line.normalized();
  PlacedSupport<double> s = support(body, Vec3(-normal));
  double overlap = s.height - normal.dot(line);
  constexpr int most = 100;
  for (int n = 0; n < most; ++n)
  {
    const TangentFrame frame = tangent_frame(normal);
    s = support(body, Vec3(-normal), frame);
    overlap = s.height - normal.dot(line);
    const Vec2 slope = -in_frame(frame, Vec3(line + s.arm));
    CurvatureRadii<double> hessian = s.radii - overlap;
    const double mean = 0.5 * (hessian.r11 + hessian.r22);
    const double radius = std::hypot(0.5 * (hessian.r11 - hessian.r22), hessian.r12);
    const double least = 1e-6 * s.height;
    if (mean - radius < least)
      hessian = hessian - (mean - radius - std::max(least, radius - mean));
    Vec2 step = -hessian.solve(slope);
    step *= std::min(1., 0.5 / step.norm());
    if (!(step.norm() > 1e-15))
      break;
    // A step counts only if it takes off half of the slope, or the overlap falls.
    bool is_better = false;
    for (double share = 1.; share > 1e-6 && !is_better; share *= 0.5)
    {
      const Vec3 trial = (normal + from_frame(frame, Vec2(step * share))).normalized();
      const PlacedSupport<double> t = support(body, Vec3(-trial));
      const double trial_overlap = t.height - trial.dot(line);
      const Vec3 gap = line + t.arm, beside = gap - trial * trial.dot(gap);
      is_better =
          trial_overlap < overlap || (trial_overlap <= overlap + 1e-15 * s.height && beside.norm() < slope.norm());
      if (is_better)
        normal = trial;
    }
    if (!is_better)
      break;
  }
  return foot_against(normal, point);
}

} // namespace

std::vector<SurfacePlace> find_surface_places(const BodyPose &body, const SurfaceView &surface,
                                              const std::span<const std::int32_t> faces)
{
  const SurfaceTopology &t = surface.topology;
  SurfaceLook look(body, surface);
  std::vector<SurfacePlace> places;
  const double deepest = deepest_overlap * std::min({body.shape.r1, body.shape.r2, body.shape.r3});
  const auto add = [&](const Feature feature, const std::int32_t number, const int index, const Foot &foot)
  {
    const std::int32_t node = feature == Feature::face   ? t.triangle[number][0]
                              : feature == Feature::edge ? t.edge[number].from
                                                         : number;
    if (foot.overlap > 0. && foot.overlap < deepest && look.is_in_front(foot, surface.node[node]))
      places.push_back({feature, number, index, foot.normal, foot.overlap, foot.arm});
  };
  std::vector<std::int32_t> edges, nodes;
  for (const std::int32_t f : faces)
  {
    edges.insert(edges.end(), t.edge_of[f].begin(), t.edge_of[f].end());
    nodes.insert(nodes.end(), t.triangle[f].begin(), t.triangle[f].end());
    if (look.face(f).overlap > 0. && look.index_of_face(f) != 0)
      add(Feature::face, f, 1, look.face(f));
  }
  for (auto *list : {&edges, &nodes})
  {
    std::sort(list->begin(), list->end());
    list->erase(std::unique(list->begin(), list->end()), list->end());
  }
  for (const std::int32_t e : edges)
    if (const int index = look.index_of_edge(e); index != 0)
      add(Feature::edge, e, index, look.edge(e));
  for (const std::int32_t node : nodes)
    if (const int index = look.index_of_vertex(node); index != 0)
      add(Feature::vertex, node, index, look.vertex(node));
  return places;
}

int sum_of_indices(const BodyPose &body, const SurfaceView &surface)
{
  SurfaceLook look(body, surface);
  int sum = 0;
  for (std::size_t f = 0; f < surface.topology.n_faces(); ++f)
    sum += look.index_of_face(static_cast<std::int32_t>(f));
  for (std::size_t e = 0; e < surface.topology.n_edges(); ++e)
    sum += look.index_of_edge(static_cast<std::int32_t>(e));
  for (std::size_t node = 0; node < surface.topology.n_nodes(); ++node)
    if (!surface.topology.corners_of(static_cast<std::int32_t>(node)).empty())
      sum += look.index_of_vertex(static_cast<std::int32_t>(node));
  return sum;
}

} // namespace bergamo::dem
