#pragma once

#include "dem/core/pack_vectors.h"
#include "fe_dealii/element/bending_geometry.h"

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace bergamo::fe::bending
{

/// The elements of a body in packs of eight. The last pack is filled up with copies of its last element, which have
/// neither volume nor stiffness.
class Elements
{
public:
  using Displacement = Points[n_dofs];

  /// @param nodes of the elements one after the other; @param corners one an element
  Elements(std::span<const unsigned int> nodes, std::vector<Corners> corners, const ElasticModuli &moduli);

  /// @param nodal_share of the body in what a two-scale model weighs, in [0, 1], at the nodes of the whole body
  void set_share(std::span<const double> nodal_share);

  std::size_t size() const { return corners_.size(); }
  std::size_t n_packs() const { return packs_.size(); }
  const Geometry<Points> &pack(const std::size_t k) const { return packs_[k]; }
  Geometry<double> geometry(std::size_t element) const; ///< of one element, the share included
  const Corners &corners(const std::size_t element) const { return corners_[element]; }
  double volume(const std::size_t element) const { return volume_[element]; } ///< whatever the share [m³]
  std::array<double, n_points> share(std::size_t element) const;              ///< at its points
  /// ∫ N share dV of its nodes [m³].
  const double *node_volume(const std::size_t element) const { return &node_volume_[n_nodes * element]; }

  /// Elements of a pack that are no copies.
  int n_lanes(const std::size_t pack) const
  {
    return static_cast<int>(std::min<std::size_t>(points_per_pack, size() - points_per_pack * pack));
  }

  /// Displacements of a pack from an array of the whole body, 3*node + component [m].
  BERGAMO_INLINE void gather(const std::size_t pack, const double *of_body, Displacement &u) const
  {
    const unsigned int *const first = &dof_of_node_[n_nodes * points_per_pack * pack];
    for (int node = 0; node < n_nodes; ++node)
    {
      const auto at = math::gather_vectors<Points>(
          [&](const int lane)
          { return Eigen::Map<const Eigen::Vector3d>(of_body + first[points_per_pack * node + lane]); });
      for (int i = 0; i < 3; ++i)
        u[3 * node + i] = at[i];
    }
  }

private:
  void make_packs();
  void make_pack(std::size_t pack);
  /// That of a lane, the last one in lanes that fill up.
  std::size_t element_of(const std::size_t pack, const int lane) const
  {
    return std::min(points_per_pack * pack + lane, size() - 1);
  }

  std::vector<unsigned int> dof_of_node_; // the first of each node: by pack, node, lane
  std::vector<double> nodal_share_;       // 1 if empty
  std::vector<Corners> corners_;
  ElasticModuli moduli_;
  std::vector<Geometry<Points>> packs_;
  std::vector<double> volume_, node_volume_;
};

/// Writes the forces of a pack. @param target target(lane): where the element's 24 numbers go
template <class Target>
BERGAMO_INLINE void scatter(const Points (&force)[n_dofs], const Target &target)
{
  for (int node = 0; node < n_nodes; ++node)
    if constexpr (std::is_same_v<Points, Pack>)
      math::scatter_vectors(Vector3<Points>(force[3 * node], force[3 * node + 1], force[3 * node + 2]),
                            [&](const int lane) { return Eigen::Map<Eigen::Vector3d>(target(lane) + 3 * node); });
    else
      for (int lane = 0; lane < points_per_pack; ++lane)
        for (int i = 0; i < 3; ++i)
          target(lane)[3 * node + i] = force[3 * node + i][lane];
}

} // namespace bergamo::fe::bending
