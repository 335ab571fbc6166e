#include "dem/geometry/surface_topology.h"

#include <algorithm>
#include <map>
#include <utility>

namespace bergamo::dem
{

SurfaceTopology::SurfaceTopology(std::vector<Triangle> triangles, const std::size_t n_nodes)
    : triangle(std::move(triangles))
{
  for (std::size_t f = 0; f < n_faces(); ++f)
    for (int k = 0; k < 3; ++k)
    {
      const std::int32_t node = triangle[f][k];
      if (node < 0 || static_cast<std::size_t>(node) >= n_nodes)
        reject_triangle(f, "triangle ", f, " names node ", node, ", but the surface has the nodes 0 to ", n_nodes,
                        " - 1");
      if (node == triangle[f][(k + 1) % 3])
        reject_triangle(f, "triangle ", f, " names node ", node, " twice: remove it from the surface");
    }
  find_edges();
  corners = Rows<Corner>(n_nodes,
                         [&](const auto &put)
                         {
                           for (std::size_t f = 0; f < n_faces(); ++f)
                             for (int k = 0; k < 3; ++k)
                               put(triangle[f][k], {static_cast<std::int32_t>(f), k});
                         });
  edges_around = Rows<std::int32_t>(n_nodes,
                                    [&](const auto &put)
                                    {
                                      for (std::size_t e = 0; e < n_edges(); ++e)
                                        for (const std::int32_t node : {edge[e].from, edge[e].to})
                                          put(node, static_cast<std::int32_t>(e));
                                    });
  check_fans();
}

bool SurfaceTopology::is_closed() const
{
  return std::none_of(edge.begin(), edge.end(), [](const Edge &e) { return e.right == none; });
}

void SurfaceTopology::find_edges()
{
  std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> known; // by the smaller and the larger node
  edge_of.resize(n_faces());
  for (std::size_t f = 0; f < n_faces(); ++f)
    for (int k = 0; k < 3; ++k)
    {
      const std::int32_t from = triangle[f][k], to = triangle[f][(k + 1) % 3], face = static_cast<std::int32_t>(f);
      const auto [place, is_new] = known.try_emplace(std::minmax(from, to), static_cast<std::int32_t>(n_edges()));
      edge_of[f][k] = place->second;
      if (is_new)
      {
        edge.push_back({from, to, face, none});
        continue;
      }
      Edge &e = edge[place->second];
      if (e.right != none)
        reject_triangle(f, "triangles ", e.left, ", ", e.right, " and ", f, " share the edge of the nodes ", from,
                        " and ", to, ": a surface has two triangles at an edge; make two surfaces of it");
      if (e.from == from)
        reject_triangle(f, "triangles ", e.left, " and ", f, " run through their edge from node ", from, " to node ",
                        to, " both: their normals point to different sides; turn one of them around");
      e.right = face;
    }
}

void SurfaceTopology::check_fans() const
{
  for (std::size_t n = 0; n < n_nodes(); ++n)
  {
    const auto node = static_cast<std::int32_t>(n);
    const std::span<const Corner> fan = corners_of(node);
    if (fan.empty())
      continue;
    std::size_t n_reached = 0;
    const auto edge_from = [&](const std::int32_t face, const int place) { return edge_of[face][place]; };
    const auto place_in = [&](const std::int32_t face) {
      return static_cast<int>(std::find(triangle[face].begin(), triangle[face].end(), node) - triangle[face].begin());
    };
    // From the face at the clockwise rim, or any one, anticlockwise around the node.
    std::int32_t face = fan[0].face;
    const auto across = [&](const std::int32_t f, const std::int32_t e)
    { return edge[e].left == f ? edge[e].right : edge[e].left; };
    for (std::size_t k = 0; k < fan.size(); ++k)
    {
      const std::int32_t before = across(face, edge_from(face, place_in(face)));
      if (before == none)
        break;
      face = before;
    }
    const std::int32_t first = face;
    do
    {
      ++n_reached;
      face = across(face, edge_from(face, (place_in(face) + 2) % 3));
    } while (face != none && face != first && n_reached < fan.size());
    if (n_reached != fan.size())
      reject_triangle(fan[0].face, "node ", node, " joins ", fan.size(), " triangles of which only ", n_reached,
                      " hang together by edges: give each part a node of its own there");
  }
}

} // namespace bergamo::dem
