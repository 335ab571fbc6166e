#include "dem/core/parallel.h"
#include "dem/force/candidates.h"
#include "dem/geometry/nearest_point.h"

#include <boost/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>

#include <algorithm>
#include <iterator>

namespace bergamo::dem
{
namespace
{

namespace bg = boost::geometry;
using Point = bg::model::point<double, 3, bg::cs::cartesian>;
using Box = bg::model::box<Point>;

/// A triangle among those of all surfaces.
struct Face
{
  std::int32_t surface, number;
  std::int32_t first_feature; ///< of its surface
};
using Entry = std::pair<Box, Face>;
using Tree = bg::index::rtree<Entry, bg::index::rstar<16>>;

Point point(const Vec3 &x)
{
  return {x[0], x[1], x[2]};
}

std::vector<Entry> boxes_of(const std::span<const Surface> surfaces)
{
  std::vector<Entry> entries;
  std::int32_t first_feature = 0;
  for (std::size_t s = 0; s < surfaces.size(); ++s)
  {
    const Surface &surface = surfaces[s];
    for (std::size_t f = 0; f < surface.topology.n_faces(); ++f)
    {
      const auto &[a, b, c] = surface.topology.triangle[f];
      const Vec3 &x = surface.node[a], &y = surface.node[b], &z = surface.node[c];
      entries.emplace_back(Box(point(x.cwiseMin(y).cwiseMin(z)), point(x.cwiseMax(y).cwiseMax(z))),
                           Face{static_cast<std::int32_t>(s), static_cast<std::int32_t>(f), first_feature});
    }
    first_feature += static_cast<std::int32_t>(surface.n_features());
  }
  return entries;
}

} // namespace

struct FaceTree
{
  explicit FaceTree(const std::span<const Surface> surfaces) : tree(boxes_of(surfaces)) // packed
  {
    for (const Surface &surface : surfaces)
    {
      node.push_back(surface.node);
      triangle.push_back(surface.topology.triangle);
    }
  }

  bool holds_for(const std::span<const Surface> surfaces) const
  {
    return std::equal(surfaces.begin(), surfaces.end(), node.begin(), node.end(),
                      [](const Surface &s, const std::vector<Vec3> &known) { return s.node == known; }) &&
           std::equal(surfaces.begin(), surfaces.end(), triangle.begin(), triangle.end(),
                      [](const Surface &s, const std::vector<Triangle> &known)
                      { return s.topology.triangle == known; });
  }

  Tree tree;
  std::vector<std::vector<Vec3>> node; // by surface [m]
  std::vector<std::vector<Triangle>> triangle;
};

std::shared_ptr<const FaceTree> face_tree(const std::span<const Surface> surfaces,
                                          const std::shared_ptr<const FaceTree> &known)
{
  return known && known->holds_for(surfaces) ? known : std::make_shared<const FaceTree>(surfaces);
}

VerletList parts_near_surfaces(const Particles &p, const std::span<const Surface> surfaces,
                               const CandidateSearch &search, const FaceTree &faces)
{
  VerletList list;
  const std::size_t n = p.parts.size();
  list.row.assign(n + 1, 0);
  if (surfaces.empty())
    return list;
  double largest_offset = 0.;
  for (const Surface &surface : surfaces)
    largest_offset = std::max(largest_offset, surface.offset);
  std::vector<std::vector<std::int32_t>> near(n);
  parallel_for(n,
               [&](const std::size_t k)
               {
                 if (p.is_fixed(p.parts.particle[k]) || !search.seeks(k))
                   return;
                 const Vec3 &centre = search.places[k];
                 const double reach_of_part = p.parts.bounding_radius[k] + search.range;
                 const Vec3 around = Vec3::Constant(reach_of_part + largest_offset);
                 std::vector<Entry> found;
                 faces.tree.query(bg::index::intersects(Box(point(centre - around), point(centre + around))),
                                  std::back_inserter(found));
                 for (const auto &[box, face] : found)
                 {
                   const Surface &surface = surfaces[face.surface];
                   const SurfaceTopology &t = surface.topology;
                   const double reach = reach_of_part + surface.offset;
                   const auto &[a, b, c] = t.triangle[face.number];
                   const auto add_near = [&](const Vec3 &nearest, const std::size_t offset, const std::int32_t number)
                   {
                     const bool is_near = (nearest - centre).norm() < reach;
                     if (is_near)
                       near[k].push_back(face.first_feature + static_cast<std::int32_t>(offset) + number);
                     return is_near;
                   };
                   const auto at = [&](const std::int32_t node) -> const Vec3 & { return surface.node[node]; };
                   if (!add_near(nearest_on_triangle(centre, at(a), at(b), at(c)), 0, face.number))
                     continue;
                   for (int side = 0; side < 3; ++side)
                   {
                     const std::int32_t edge = t.edge_of[face.number][side], node = t.triangle[face.number][side];
                     add_near(nearest_on_line(centre, at(t.edge[edge].from), at(t.edge[edge].to)), t.n_faces(), edge);
                     add_near(at(node), t.n_faces() + t.n_edges(), node);
                   }
                 }
                 std::sort(near[k].begin(), near[k].end());
                 near[k].erase(std::unique(near[k].begin(), near[k].end()), near[k].end());
               });
  for (std::size_t k = 0; k < n; ++k)
  {
    list.first.insert(list.first.end(), near[k].size(), static_cast<std::int32_t>(k));
    list.second.insert(list.second.end(), near[k].begin(), near[k].end());
    list.row[k + 1] = static_cast<std::int32_t>(list.second.size());
  }
  list.image.assign(list.size(), own_image);
  return list;
}

} // namespace bergamo::dem
