#include "fe_dealii/boundary/node_images.h"

#include "dem/core/error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

namespace bergamo::fe
{
namespace
{

constexpr double tolerance = 1e-6; // of places, in edges of the box

struct Faces
{
  NodeImages::Vector low, edge;

  explicit Faces(const std::span<const NodeImages::Vector> position)
  {
    low.fill(std::numeric_limits<double>::infinity());
    NodeImages::Vector high;
    high.fill(-std::numeric_limits<double>::infinity());
    for (const auto &place : position)
      for (std::size_t d = 0; d < 3; ++d)
      {
        low[d] = std::min(low[d], place[d]);
        high[d] = std::max(high[d], place[d]);
      }
    for (std::size_t d = 0; d < 3; ++d)
      edge[d] = high[d] - low[d];
  }

  double share(const NodeImages::Vector &place, const std::size_t d) const { return (place[d] - low[d]) / edge[d]; }
};

} // namespace

NodeImages::NodeImages(const std::span<const Vector> position, const std::array<bool, 3> is_periodic)
    : is_periodic_(is_periodic)
{
  const Faces faces(position);
  std::vector<std::array<int, 3>> shift(position.size());
  std::map<std::array<long, 3>, std::vector<unsigned int>> at; // by place, that of upper faces on the lower ones
  for (unsigned int node = 0; node < position.size(); ++node)
  {
    std::array<long, 3> key{};
    for (std::size_t d = 0; d < 3; ++d)
    {
      const double share = faces.share(position[node], d);
      shift[node][d] = is_periodic[d] && share > 1. - 0.5 * tolerance;
      key[d] = std::lround((share - shift[node][d]) / tolerance);
    }
    at[key].push_back(node);
  }

  first_.resize(position.size());
  std::iota(first_.begin(), first_.end(), 0u);
  is_imaged_.assign(position.size(), false);
  const auto sum = [&](const unsigned int node) { return shift[node][0] + shift[node][1] + shift[node][2]; };
  for (auto &[key, nodes] : at)
  {
    std::size_t n_images = 1;
    for (std::size_t d = 0; d < 3; ++d)
      n_images *= is_periodic[d] && key[d] == 0 ? 2 : 1;
    if (nodes.size() != n_images)
    {
      const Vector &place = position[nodes[0]];
      reject("a body that repeats itself has a node at (", place[0], ", ", place[1], ", ", place[2],
             ") m without a node on the opposite face, or with several; mesh opposite faces alike");
    }
    if (n_images == 1)
      continue;
    std::stable_sort(nodes.begin(), nodes.end(), [&](const auto a, const auto b) { return sum(a) < sum(b); });
    Group group{nodes, {}};
    for (const unsigned int node : nodes)
    {
      group.shift.push_back(shift[node]);
      first_[node] = nodes[0];
      is_imaged_[node] = true;
    }
    groups_.push_back(std::move(group));
  }
  std::sort(groups_.begin(), groups_.end(), [](const Group &a, const Group &b) { return a.nodes[0] < b.nodes[0]; });
}

} // namespace bergamo::fe
