#pragma once

#include "dem/neighbour/verlet_list.h"
#include "dem/state/particles.h"
#include "dem/state/surface.h"
#include "dem/state/wall.h"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace bergamo::dem
{

/// Which candidates are looked for, and where.
struct CandidateSearch
{
  double range;                              ///< beyond the bounding radii [m]
  std::span<const Vec3> places = {};         ///< centres of the parts [m]; none given, where they are
  std::span<const std::uint8_t> sought = {}; ///< by part: only pairs with one of these are; none given, all

  bool seeks(const std::size_t part) const { return sought.empty() || sought[part]; }
};

/// Pairs of parts of different particles that are nearer than their bounding radii plus the range; pairs of two fixed
/// particles are left out. @param search with places
VerletList near_parts(const Particles &particles, const CandidateSearch &search);

/// Parts of free particles that are nearer to a wall than their bounding radius plus the range: rows by part, the
/// second of a pair is the wall. @param search with places
VerletList parts_near_walls(const Particles &particles, const std::vector<PlaneWall> &walls,
                            const CandidateSearch &search);

/// Tree of the boxes around all triangles of surfaces where they lie; the one known if that is still true.
struct FaceTree;
std::shared_ptr<const FaceTree> face_tree(std::span<const Surface> surfaces,
                                          const std::shared_ptr<const FaceTree> &known);

/// Parts of free particles and features of surfaces that are nearer to one another than the part's bounding radius plus
/// the range: rows by part, the second of a pair counts as in feature_of(). @param search with places
VerletList parts_near_surfaces(const Particles &particles, std::span<const Surface> surfaces,
                               const CandidateSearch &search, const FaceTree &tree);

/// Deals a list out to several, in its order. @param class_of class_of(first, second) of a pair, in [0, n)
template <class ClassOf>
std::vector<VerletList> split(VerletList list, const std::size_t n, const ClassOf &class_of)
{
  std::vector<VerletList> lists(n);
  for (VerletList &one : lists)
    one.row.assign(list.row.size(), 0);
  if (list.size() == 0)
    return lists;
  const auto class_of_pair = [&](const std::size_t pair) -> std::size_t
  { return class_of(list.first[pair], list.second[pair]); };
  const std::size_t first_class = class_of_pair(0);
  std::size_t pair = 1;
  while (pair < list.size() && class_of_pair(pair) == first_class)
    ++pair;
  if (pair == list.size()) // as mostly
  {
    lists[first_class] = std::move(list);
    return lists;
  }
  for (std::size_t i = 0; i + 1 < list.row.size(); ++i)
  {
    for (auto k = list.row[i]; k < list.row[i + 1]; ++k)
    {
      VerletList &one = lists[class_of_pair(k)];
      one.first.push_back(list.first[k]);
      one.second.push_back(list.second[k]);
      one.image.push_back(list.image[k]);
    }
    for (VerletList &one : lists)
      one.row[i + 1] = static_cast<std::int32_t>(one.second.size());
  }
  return lists;
}

} // namespace bergamo::dem
