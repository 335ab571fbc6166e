#pragma once

#include "dem/geometry/contact_geometry.h"
#include "dem/geometry/surface_topology.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <vector>

/// Where a convex body touches a surface of triangles.
///
/// Face, edge and vertex are features of one surface. At each a body may have a place with a common normal c: it lies
/// in the feature's cone of normals, and the body's deepest point against c lies above the feature. On an infinite
/// plane there is one; if that is bent anywhere in any way, places come and go in pairs of opposite index, because
/// their sum is the degree of a map (as in Morse theory: Milnor 1963). So places at convex edges count +1, those at
/// concave ones -1:
///  * a body that goes over a convex edge goes from the place on a face to that on the edge to that on the next face;
///  * before the second of two faces that meet in a concave edge is touched, or while it is, nothing jumps: where the
///    bend is slight, both faces and the edge are touched, 1 + 1 - 1, the energy of the union of two half-spaces as
///    that of both less that of their intersection; where it is not, the edge is not reached and there are two
///    contacts;
///  * triangles in one plane are one plane, whatever their edges.
/// The energy sum of index times energy of the place is a continuous function of the body's placement, and the forces
/// are its derivatives. No distance or angle is tuned. Indices come from the signs of few numbers that neighbours
/// share, so they add up whatever the rounding.
namespace bergamo::dem
{

enum class Feature : std::uint8_t
{
  face,
  edge,
  vertex
};

/// A place where a body touches a surface.
struct SurfacePlace
{
  Feature feature;
  std::int32_t number; ///< of the face, edge or node
  int index;           ///< how often it counts: 1 on faces and where the surface is convex
  Vec3 normal;         ///< unit, from the surface to the body
  double overlap;      ///< along the normal, > 0 [m]
  Vec3 arm;            ///< deepest point of the body minus its centre [m]
};

/// Deeper than this share of its smallest half-axis a body touches nothing: features on its far side are that deep.
/// Nor do places of negative index count that such deep ones give.
inline constexpr double deepest_overlap = 0.5;

/// In a surface that bends a body is never at once deeper than this share, unless it comes from a contact about as deep
/// or was too deep to be touched: then it is not until it has come off so far. A force that began at the deepest
/// overlap would throw both.
inline constexpr double deepest_begin = 0.1;

/// A direction in which a body is apart from a feature.
struct SeparatingDirection
{
  Vec3 direction = Vec3::Zero(); ///< unit, from the feature to the body
  double gap = 0.;               ///< along it, a lower bound of the distance; <= 0 where none was found [m]
};

/// A surface at one moment.
struct SurfaceView
{
  const SurfaceTopology &topology;
  std::span<const Vec3> node; ///< places [m]
  double offset = 0.;         ///< see Surface [m]
};

/// A surface as one body sees it; what was looked at is remembered.
class SurfaceLook
{
public:
  /// By reference.
  SurfaceLook(const BodyPose &body, const SurfaceView &surface) : body(body), surface(surface) {}

  /// The place at a feature, if the body touches it there: its centre is in front, and it is not as deep as that.
  std::optional<SurfacePlace> place_at(Feature feature, std::int32_t number);

  /// Whether a body that comes from no other contact may begin to touch there, see deepest_begin.
  bool may_begin(const SurfacePlace &place) const { return place.overlap <= deepest_begin * least_half_axis(); }

  /// Overlap with the plane of a face, the line of an edge or a vertex, whether its place is there or not [m].
  double overlap_at(Feature feature, std::int32_t number) { return foot_on(feature, number).overlap; }

  /// Index of the place at a feature, whether touched or not; 0 where there is none.
  int index_of(Feature feature, std::int32_t number);

  /// How far any of the deepest points that decided the last index_of() may go before it can be another [m].
  double margin() const { return least_margin; }

  /// What parts the body from a feature, as a closed set of points, along the best direction that a few steps find.
  SeparatingDirection separation_from(Feature feature, std::int32_t number) const;

  /// Distance of the deepest point against a face from the lines of its edges, > 0 inside [m].
  double distance_to_edges(std::int32_t face);

  /// Normal of a face that a feature belongs to.
  Vec3 normal_beside(Feature feature, std::int32_t number) const;

private:
  /// Where the body is deepest along a normal.
  struct Foot
  {
    Vec3 normal;
    Vec3 arm;       ///< deepest point minus the body's centre [m]
    double overlap; ///< [m]
  };

  /// Deepest against the plane of a face.
  struct FaceFoot
  {
    std::int32_t face;
    Foot foot;
    std::array<double, 3> inside; ///< distance from the lines of the edges, > 0 on the face's side [m]
    std::array<bool, 3> is_inside;
  };

  /// Deepest at the line of an edge.
  struct EdgeFoot
  {
    std::int32_t edge;
    Foot foot;
    double beyond_from, beyond_to; ///< distance from its nodes, > 0 on the edge's side [m]
    bool is_beyond_from, is_beyond_to;
  };

  Foot foot_on(Feature feature, std::int32_t number);
  const FaceFoot &on_face(std::int32_t face);
  const EdgeFoot &on_edge(std::int32_t edge);
  FaceFoot look_at_face(std::int32_t face) const;
  EdgeFoot look_at_edge(std::int32_t edge);
  Foot foot_on_vertex(std::int32_t node);
  Foot foot_at(const Vec3 &point, const Vec3 &guess) const;
  Foot foot_against(const Vec3 &normal, const Vec3 &point) const;
  bool is_inside(std::int32_t face, std::int32_t edge);
  bool is_beyond(std::int32_t edge, std::int32_t node);
  bool is_in_cone(std::int32_t node, const Foot &foot) const;
  bool is_beside_deep_places(std::int32_t node);
  bool is_between_shallow_places(Feature feature, std::int32_t number);
  double least_half_axis() const { return std::min({body.shape.r1, body.shape.r2, body.shape.r3}); }
  int index_of_face(std::int32_t face);
  int index_of_line(std::int32_t edge);
  int index_of_edge(std::int32_t edge);
  int index_of_vertex(std::int32_t node);
  Vec3 normal_of(std::int32_t face) const;
  Vec3 nearest_on(Feature feature, std::int32_t number, const Vec3 &point) const;
  /// Repeated where there are less.
  std::array<std::int32_t, 3> nodes_of(Feature feature, std::int32_t number) const;

  const BodyPose &body;
  const SurfaceView &surface;
  double least_margin = 0.;
  std::deque<FaceFoot> faces; // few: found by looking through them
  std::deque<EdgeFoot> edges;
};

/// All places at which a body touches.
/// @param faces that may be touched, in any order, each once: those within the body's reach
std::vector<SurfacePlace> find_surface_places(const BodyPose &body, const SurfaceView &surface,
                                              std::span<const std::int32_t> faces);

/// Sum of the indices of all places on all features, touched or not: 1 above a surface without holes.
int sum_of_indices(const BodyPose &body, const SurfaceView &surface);

} // namespace bergamo::dem
