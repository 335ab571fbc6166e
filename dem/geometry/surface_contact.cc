#include "dem/geometry/surface_contact.h"

#include "dem/geometry/nearest_point.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

namespace bergamo::dem
{

SurfaceLook::Foot SurfaceLook::foot_against(const Vec3 &normal, const Vec3 &point) const
{
  const PlacedSupport<double> s = support(body, Vec3(-normal));
  return {normal, s.arm, s.height - normal.dot(body.position - point) + surface.offset};
}

const SurfaceLook::FaceFoot &SurfaceLook::on_face(const std::int32_t f)
{
  for (const FaceFoot &known : faces)
    if (known.face == f)
      return known;
  return faces.emplace_back(look_at_face(f));
}

const SurfaceLook::EdgeFoot &SurfaceLook::on_edge(const std::int32_t e)
{
  for (const EdgeFoot &known : edges)
    if (known.edge == e)
      return known;
  const EdgeFoot found = look_at_edge(e);
  return edges.emplace_back(found);
}

/// One copy of machine code: two would round differently, and indices add up only if all ask for the same signs.
[[gnu::noinline]] SurfaceLook::FaceFoot SurfaceLook::look_at_face(const std::int32_t f) const
{
  const Triangle &t = surface.topology.triangle[f];
  const Vec3 &a = surface.node[t[0]];
  const Vec3 normal = normal_of(f);
  FaceFoot found{f, foot_against(normal, a), {}, {}};
  for (int k = 0; k < 3; ++k)
  {
    const SurfaceTopology::Edge &e = surface.topology.edge[surface.topology.edge_of[f][k]];
    const Vec3 along = surface.node[e.to] - surface.node[e.from]; // the same for both faces
    const double side = normal.cross(along).dot(body.position + found.foot.arm - surface.node[e.from]);
    found.is_inside[k] = e.left == f ? side >= 0. : side < 0.;
    found.inside[k] = (e.left == f ? side : -side) / along.norm();
  }
  return found;
}

/// Whether the deepest point against a face lies on the face's side of its edge.
bool SurfaceLook::is_inside(const std::int32_t f, const std::int32_t e)
{
  const auto &its_edges = surface.topology.edge_of[f];
  const auto k = std::find(its_edges.begin(), its_edges.end(), e) - its_edges.begin();
  const FaceFoot &found = on_face(f);
  least_margin = std::min(least_margin, std::abs(found.inside[k]));
  return found.is_inside[k];
}

double SurfaceLook::distance_to_edges(const std::int32_t f)
{
  const auto &inside = on_face(f).inside;
  return *std::min_element(inside.begin(), inside.end());
}

/// Index of the place on the line of an edge: places on both faces count, as they would on infinite ones.
int SurfaceLook::index_of_line(const std::int32_t e)
{
  const SurfaceTopology::Edge &between = surface.topology.edge[e];
  const bool has_right = between.right != SurfaceTopology::none;
  return 1 - is_inside(between.left, e) - (has_right && is_inside(between.right, e));
}

/// Whether the place on the line of an edge lies on the edge's side of one of its nodes.
bool SurfaceLook::is_beyond(const std::int32_t e, const std::int32_t node)
{
  const EdgeFoot &found = on_edge(e);
  const bool is_from = surface.topology.edge[e].from == node;
  least_margin = std::min(least_margin, std::abs(is_from ? found.beyond_from : found.beyond_to));
  return is_from ? found.is_beyond_from : found.is_beyond_to;
}

int SurfaceLook::index_of_face(const std::int32_t f)
{
  const FaceFoot &found = on_face(f);
  const auto &[a, b, c] = found.inside;
  const bool is_inside = found.is_inside[0] && found.is_inside[1] && found.is_inside[2];
  const double least = std::min({a, b, c}); // outside, the edge that it is furthest beyond decides
  least_margin = std::abs(least);
  return is_inside;
}

int SurfaceLook::index_of_edge(const std::int32_t e)
{
  const int index = index_of_line(e);
  const SurfaceTopology::Edge &ends = surface.topology.edge[e];
  return index != 0 && is_beyond(e, ends.from) && is_beyond(e, ends.to) ? index : 0;
}

/// What the sectors and rays of the infinite fan leave of its one place.
int SurfaceLook::index_of_vertex(const std::int32_t node)
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

int SurfaceLook::index_of(const Feature feature, const std::int32_t number)
{
  least_margin = std::numeric_limits<double>::infinity();
  switch (feature)
  {
  case Feature::face:
    return index_of_face(number);
  case Feature::edge:
    return index_of_edge(number);
  default:
    return index_of_vertex(number);
  }
}

/// The normal turns from one face's to the other's until the deepest point lies straight above the edge: the slope
/// changes its sign between, so the angle is found for any body by steps of Newton kept within the bracket.
[[gnu::noinline]] SurfaceLook::EdgeFoot SurfaceLook::look_at_edge(const std::int32_t e)
{
  const SurfaceTopology::Edge &ends = surface.topology.edge[e];
  const Vec3 &point = surface.node[ends.from];
  const Vec3 along = (surface.node[ends.to] - point).normalized(), first = on_face(ends.left).foot.normal,
             across = first.cross(along);
  // `across` points into the left face; the normal goes from `first` towards minus it where the edge is convex.
  double end = M_PI;
  if (ends.right != SurfaceTopology::none)
  {
    const Vec3 &other = on_face(ends.right).foot.normal;
    end = std::atan2(-across.dot(other), first.dot(other));
    constexpr double rounding = 1e-9; // of triangles back to back, which are a rim: the sign says nothing
    if (end < rounding - M_PI)
      end = M_PI;
  }
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
    const double depth = s.height - normal.dot(body.position - point);
    foot = {normal, s.arm, depth + surface.offset};
    const double slope = -turned.dot(body.position + s.arm - point); // of the overlap
    const double curvature = s.radii.r11 - depth;
    (slope > 0. ? high : low) = angle;
    const double newton = angle - slope / curvature;
    const bool gets_on = std::abs(slope) < 0.5 * last && curvature > 0. && newton > low && newton < high;
    const double next = gets_on ? newton : 0.5 * (low + high);
    if (slope == 0. || std::abs(next - angle) < 1e-15)
      break;
    last = std::abs(slope);
    angle = next;
  }
  const Vec3 deepest = body.position + foot.arm;
  const double from = along.dot(deepest - point), to = -along.dot(deepest - surface.node[ends.to]);
  return {e, foot, from, to, from > 0., to >= 0.};
}

/// Newton on the sphere for the normal along which the body is least deep at a point, with steps that never raise it.
/// @param guess unit vector
SurfaceLook::Foot SurfaceLook::foot_at(const Vec3 &point, const Vec3 &guess) const
{
  const Vec3 line = body.position - point;
  Vec3 normal = guess;
  constexpr int most = 100;
  for (int n = 0; n < most; ++n)
  {
    const TangentFrame frame = tangent_frame(normal);
    const PlacedSupport<double> s = support(body, Vec3(-normal), frame);
    const double overlap = s.height - normal.dot(line);
    const Vec2 slope = -in_frame(frame, Vec3(line + s.arm));
    CurvatureRadii<double> hessian = s.radii - overlap;
    const double mean = 0.5 * (hessian.r11 + hessian.r22);
    const double radius = std::hypot(0.5 * (hessian.r11 - hessian.r22), hessian.r12), low = mean - radius;
    const double least = 1e-6 * s.height;
    if (low < least)
      hessian = hessian - (low - std::max(least, std::abs(low)));
    Vec2 step = -hessian.solve(slope);
    step *= std::min(1., 0.5 / step.norm());
    if (!(step.norm() > 1e-15))
      break;
    bool is_better = false;
    for (double share = 1.; share > 1e-6 && !is_better; share *= 0.5)
    {
      const Vec3 trial = (normal + from_frame(frame, Vec2(step * share))).normalized();
      const PlacedSupport<double> t = support(body, Vec3(-trial));
      const double trial_overlap = t.height - trial.dot(line);
      const Vec3 gap = line + t.arm, beside = gap - trial * trial.dot(gap);
      // To rounding it is flat near the minimum: there the smaller slope decides.
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

/// A place at a vertex has its normal in the vertex's cone, where the ends of its edges are lower.
bool SurfaceLook::is_in_cone(const std::int32_t node, const Foot &foot) const
{
  constexpr double rounding = 1e-12;
  const auto edges_around = surface.topology.edges_of(node);
  return std::all_of(edges_around.begin(), edges_around.end(),
                     [&](const std::int32_t e)
                     {
                       const SurfaceTopology::Edge &ends = surface.topology.edge[e];
                       const Vec3 way = surface.node[ends.from == node ? ends.to : ends.from] - surface.node[node];
                       return foot.normal.dot(way) <= rounding * way.norm();
                     });
}

/// Whether all places that leave a vertex none are too deep to be touched, and it is not plainly apart. Two more
/// places, of index 1 and -1, are there then if a body that is slender or pointed touches it beside them.
bool SurfaceLook::is_beside_deep_places(const std::int32_t node)
{
  const SurfaceTopology &t = surface.topology;
  const double deepest = deepest_overlap * least_half_axis();
  for (const auto &[f, place] : t.corners_of(node))
    if (is_inside(f, t.edge_of[f][place]) && is_inside(f, t.edge_of[f][(place + 2) % 3]) &&
        on_face(f).foot.overlap <= deepest)
      return false;
  const Vec3 line = body.position - surface.node[node];
  if (!(foot_against(line.normalized(), surface.node[node]).overlap > 0.))
    return false; // apart, as most are
  for (const std::int32_t e : t.edges_of(node))
    if (index_of_line(e) != 0 && is_beyond(e, node) && on_edge(e).foot.overlap <= deepest)
      return false;
  return true;
}

/// Whether all places that a place of negative index is taken from, those of the infinite faces and edges around it,
/// are shallow enough to be touched. They are deeper than it is: alone it would pull the body in, ever more.
bool SurfaceLook::is_between_shallow_places(const Feature feature, const std::int32_t number)
{
  const SurfaceTopology &t = surface.topology;
  const double deepest = deepest_overlap * least_half_axis() + surface.offset;
  const auto is_shallow = [&](const std::int32_t face) { return on_face(face).foot.overlap <= deepest; };
  if (feature == Feature::edge)
    return is_shallow(t.edge[number].left) && is_shallow(t.edge[number].right);
  for (const auto &[f, place] : t.corners_of(number))
    if (is_inside(f, t.edge_of[f][place]) && is_inside(f, t.edge_of[f][(place + 2) % 3]) && !is_shallow(f))
      return false;
  for (const std::int32_t e : t.edges_of(number))
    if (index_of_line(e) > 0 && is_beyond(e, number) && on_edge(e).foot.overlap > deepest)
      return false;
  return true;
}

/// The cone of normals of a vertex lies between those of its faces and edges, and a body may have several least depths
/// at a point: searches start from all of these normals and from the middle of the body.
SurfaceLook::Foot SurfaceLook::foot_on_vertex(const std::int32_t node)
{
  const Vec3 &point = surface.node[node];
  Vec3 mean = Vec3::Zero();
  std::vector<Vec3> starts;
  for (const auto &[f, place] : surface.topology.corners_of(node))
  {
    starts.push_back(on_face(f).foot.normal);
    mean += starts.back();
  }
  for (const std::int32_t e : surface.topology.edges_of(node))
    starts.push_back(on_edge(e).foot.normal);
  const Vec3 line = body.position - point;
  starts.push_back(mean.dot(line) > 0. ? line.normalized() : starts[0]);
  std::vector<Foot> tried;
  for (const Vec3 &start : starts)
    tried.push_back(foot_against(start, point));
  const auto is_less_deep = [](const Foot &a, const Foot &b) { return a.overlap < b.overlap; };
  std::sort(tried.begin(), tried.end(), is_less_deep);
  if (!(tried[0].overlap > 0.))
    return tried[0]; // apart
  Foot least = foot_at(point, tried[0].normal);
  bool least_is_in_cone = is_in_cone(node, least);
  for (std::size_t k = 1; k < tried.size(); ++k)
  {
    if ((tried[k].normal - tried[k - 1].normal).squaredNorm() <= 1e-6)
      continue;
    const Foot other = foot_at(point, tried[k].normal);
    const bool other_is_in_cone = is_in_cone(node, other);
    if (other_is_in_cone != least_is_in_cone ? other_is_in_cone : other.overlap < least.overlap)
    {
      least = other;
      least_is_in_cone = other_is_in_cone;
    }
  }
  return least;
}

SurfaceLook::Foot SurfaceLook::foot_on(const Feature feature, const std::int32_t number)
{
  switch (feature)
  {
  case Feature::face:
    return on_face(number).foot;
  case Feature::edge:
    return on_edge(number).foot;
  default:
    return foot_on_vertex(number);
  }
}

std::array<std::int32_t, 3> SurfaceLook::nodes_of(const Feature feature, const std::int32_t number) const
{
  switch (feature)
  {
  case Feature::face:
    return surface.topology.triangle[number];
  case Feature::edge:
  {
    const SurfaceTopology::Edge &e = surface.topology.edge[number];
    return {e.from, e.to, e.to};
  }
  default:
    return {number, number, number};
  }
}

Vec3 SurfaceLook::nearest_on(const Feature feature, const std::int32_t number, const Vec3 &point) const
{
  const auto node = [&](const std::int32_t n) -> const Vec3 & { return surface.node[n]; };
  const auto n = nodes_of(feature, number);
  switch (feature)
  {
  case Feature::face:
    return nearest_on_triangle(point, node(n[0]), node(n[1]), node(n[2]));
  case Feature::edge:
    return nearest_on_line(point, node(n[0]), node(n[1]));
  default:
    return node(n[0]);
  }
}

/// Newton's steps for the nearest points of feature and body, from the normal of a face or from the direction of the
/// centre, whichever parts them more. Any direction gives a bound, so few steps do, and they need not converge.
SeparatingDirection SurfaceLook::separation_from(const Feature feature, const std::int32_t number) const
{
  constexpr int most = 16;
  constexpr double good_enough = 0.7;  // gap over the distance of two points that are no nearer than the nearest ones
  constexpr double longest_step = 0.5; // [rad]
  const auto nodes = nodes_of(feature, number);
  const auto look_along = [&](const Vec3 &direction)
  {
    const PlacedSupport<double> s = support(body, Vec3(-direction), tangent_frame(direction));
    double highest = -std::numeric_limits<double>::infinity();
    for (const std::int32_t node : nodes)
      highest = std::max(highest, direction.dot(surface.node[node] - body.position));
    return std::pair(s, SeparatingDirection{direction, -s.height - highest});
  };
  auto [s, best] = look_along(normal_beside(feature, number));
  const Vec3 from_centre = body.position - nearest_on(feature, number, body.position);
  if (from_centre.norm() > 0.)
    if (const auto other = look_along(from_centre.normalized()); other.second.gap > best.gap)
      std::tie(s, best) = other;
  double share = 1.;
  for (int n = 0; n < most && share > 0.05; ++n)
  {
    const Vec3 deepest = body.position + s.arm, line = deepest - nearest_on(feature, number, deepest);
    if (best.gap > good_enough * line.norm())
      break;
    const double apart = std::max(1e-3 * s.height, best.gap);
    const TangentFrame frame = tangent_frame(best.direction);
    Vec2 step = (s.radii - -apart).solve(in_frame(frame, line));
    step *= share * std::min(1., longest_step / step.norm());
    const auto next = look_along((best.direction + from_frame(frame, step)).normalized());
    if (next.second.gap > best.gap)
      std::tie(s, best) = next;
    else
      share *= 0.5;
  }
  best.gap -= surface.offset;
  return best;
}

Vec3 SurfaceLook::normal_beside(const Feature feature, const std::int32_t number) const
{
  const SurfaceTopology &t = surface.topology;
  const std::int32_t face = feature == Feature::face   ? number
                            : feature == Feature::edge ? t.edge[number].left
                                                       : t.corners_of(number)[0].face;
  return normal_of(face);
}

Vec3 SurfaceLook::normal_of(const std::int32_t face) const
{
  const Triangle &t = surface.topology.triangle[face];
  const Vec3 &a = surface.node[t[0]];
  return (surface.node[t[1]] - a).cross(surface.node[t[2]] - a).normalized();
}

std::optional<SurfacePlace> SurfaceLook::place_at(const Feature feature, const std::int32_t number)
{
  const SurfaceTopology &t = surface.topology;
  if (feature == Feature::face && !(on_face(number).foot.overlap > 0.))
    return {};
  int index = index_of(feature, number);
  if (index == 0 && feature == Feature::vertex && is_beside_deep_places(number))
    index = is_in_cone(number, foot_on_vertex(number));
  if (index == 0 || (index < 0 && !is_between_shallow_places(feature, number)))
    return {};
  const std::int32_t node = feature == Feature::face   ? t.triangle[number][0]
                            : feature == Feature::edge ? t.edge[number].from
                                                       : number;
  const Foot foot = foot_on(feature, number);
  const double deepest = deepest_overlap * least_half_axis();
  const bool is_in_front = foot.normal.dot(body.position - surface.node[node]) > 0.;
  if (!(foot.overlap > 0.) || foot.overlap - surface.offset > deepest || !is_in_front)
    return {};
  return SurfacePlace{feature, number, index, foot.normal, foot.overlap, foot.arm};
}

std::vector<SurfacePlace> find_surface_places(const BodyPose &body, const SurfaceView &surface,
                                              const std::span<const std::int32_t> faces)
{
  const SurfaceTopology &t = surface.topology;
  std::vector<std::int32_t> edges, nodes;
  for (const std::int32_t f : faces)
  {
    edges.insert(edges.end(), t.edge_of[f].begin(), t.edge_of[f].end());
    nodes.insert(nodes.end(), t.triangle[f].begin(), t.triangle[f].end());
  }
  for (auto *list : {&edges, &nodes})
  {
    std::sort(list->begin(), list->end());
    list->erase(std::unique(list->begin(), list->end()), list->end());
  }
  SurfaceLook look(body, surface);
  std::vector<SurfacePlace> places;
  const auto add_all = [&](const Feature feature, const std::span<const std::int32_t> numbers)
  {
    for (const std::int32_t number : numbers)
      if (const auto place = look.place_at(feature, number))
        places.push_back(*place);
  };
  add_all(Feature::face, faces);
  add_all(Feature::edge, edges);
  add_all(Feature::vertex, nodes);
  return places;
}

int sum_of_indices(const BodyPose &body, const SurfaceView &surface)
{
  const SurfaceTopology &t = surface.topology;
  SurfaceLook look(body, surface);
  int sum = 0;
  for (std::size_t f = 0; f < t.n_faces(); ++f)
    sum += look.index_of(Feature::face, static_cast<std::int32_t>(f));
  for (std::size_t e = 0; e < t.n_edges(); ++e)
    sum += look.index_of(Feature::edge, static_cast<std::int32_t>(e));
  for (std::size_t node = 0; node < t.n_nodes(); ++node)
    if (!t.corners_of(static_cast<std::int32_t>(node)).empty())
      sum += look.index_of(Feature::vertex, static_cast<std::int32_t>(node));
  return sum;
}

} // namespace bergamo::dem
