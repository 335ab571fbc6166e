#pragma once

#include "dem/core/error.h"
#include "dem/core/rows.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <sstream>
#include <string>
#include <vector>

namespace bergamo::dem
{

/// Node numbers of a triangle, anticlockwise as seen from where the grains are.
using Triangle = std::array<std::int32_t, 3>;

/// A triangle that makes no surface; who knows places may add where it lies.
class TriangleError : public ConfigError
{
public:
  TriangleError(const std::string &message, std::size_t triangle)
      : ConfigError(message), triangle(static_cast<std::int32_t>(triangle))
  {
  }

  std::int32_t triangle;
};

/// Throws TriangleError with the parts as << writes them, one after the other.
template <class... Parts>
[[noreturn]] void reject_triangle(const std::size_t triangle, const Parts &...parts)
{
  std::ostringstream message;
  (message << ... << parts);
  throw TriangleError(message.str(), triangle);
}

/// Faces, edges and vertices of a surface of triangles, and who lies beside whom. It knows no places, so it stays while
/// the surface moves. Surfaces may be open, and have parts that are not connected; but two faces at most share an edge,
/// and those of a vertex form one fan.
class SurfaceTopology
{
public:
  static constexpr std::int32_t none = -1;

  struct Edge
  {
    std::int32_t from, to; ///< nodes, in the direction of the left face
    std::int32_t left;     ///< face
    std::int32_t right;    ///< face that runs through it from `to` to `from`, or none at the rim of an open surface
  };

  /// Where a face and a vertex meet.
  struct Corner
  {
    std::int32_t face;
    int place; ///< of the vertex among the three of the face
  };

  SurfaceTopology() = default;

  /// Throws TriangleError naming triangle and nodes: for a node that is not there or comes twice, an edge of more than
  /// two faces or of two that run through it in the same direction, and fans that touch at a vertex alone.
  SurfaceTopology(std::vector<Triangle> triangles, std::size_t n_nodes);

  std::size_t n_nodes() const { return corners.size(); }
  std::size_t n_faces() const { return triangle.size(); }
  std::size_t n_edges() const { return edge.size(); }

  bool is_closed() const; ///< without a rim

  std::span<const Corner> corners_of(const std::int32_t node) const { return corners[node]; }
  std::span<const std::int32_t> edges_of(const std::int32_t node) const { return edges_around[node]; }

  std::vector<Triangle> triangle;                   ///< by face
  std::vector<std::array<std::int32_t, 3>> edge_of; ///< by face: k runs from node k to node k + 1
  std::vector<Edge> edge;

private:
  void find_edges();
  void check_fans() const;

  Rows<Corner> corners;            // by node
  Rows<std::int32_t> edges_around; // by node
};

} // namespace bergamo::dem
