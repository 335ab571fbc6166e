#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace bergamo::fe
{

/// Nodes of a body that repeats itself along some directions of the global frame: nodes at the same place of opposite
/// faces are images of one another. They move alike, but for the velocity of the upper face against the lower one.
class NodeImages
{
public:
  using Vector = std::array<double, 3>;

  NodeImages() = default; ///< nothing repeats itself

  /// The faces are those of the box about all nodes.
  /// @param position reference places [m]; @param is_periodic by direction, one at least
  /// @throws ConfigError where a node of a face has no image on the opposite one, by its place
  NodeImages(std::span<const Vector> position, std::array<bool, 3> is_periodic);

  /// A node on the lower faces, with its images on the upper ones.
  struct Group
  {
    std::vector<unsigned int> nodes;       ///< the first is on lower faces alone
    std::vector<std::array<int, 3>> shift; ///< 0 or 1 by direction, of each of them
  };

  bool empty() const { return groups_.empty(); }
  const std::vector<Group> &groups() const { return groups_; }
  const std::array<bool, 3> &is_periodic() const { return is_periodic_; }

  bool has(const std::size_t node) const { return !first_.empty() && is_imaged_[node]; }
  /// The node of its group that is on lower faces alone; the node itself where it has no images.
  unsigned int first_of(const std::size_t node) const
  {
    return first_.empty() ? static_cast<unsigned int>(node) : first_[node];
  }

private:
  std::array<bool, 3> is_periodic_{};
  std::vector<Group> groups_;       // by their first nodes, ascending
  std::vector<unsigned int> first_; // by node; none where nothing repeats itself
  std::vector<bool> is_imaged_;
};

} // namespace bergamo::fe
