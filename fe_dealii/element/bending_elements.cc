#include "fe_dealii/element/bending_elements.h"

#include "dem/core/parallel.h"
#include "fe_dealii/element/hexahedron.h"

#include <cassert>
#include <type_traits>

namespace bergamo::fe::bending
{
namespace
{

/// All numbers of a geometry, in one order for one element and for eight. @param take take(number of one or of eight)
template <class One, class Eight, class Take>
void for_each_number(One &one, Eight &eight, const Take &take)
{
  take(one.volume, eight.volume);
  for (int node = 0; node < n_nodes; ++node)
  {
    for (int i = 0; i < 3; ++i)
      take(one.gradient[i][node], eight.gradient[i][node]);
    for (int mode = 0; mode < n_modes; ++mode)
      take(one.amplitude[mode][node], eight.amplitude[mode][node]);
  }
  for (int k = 0; k < packed(n_amplitudes, 0); ++k)
    take(one.stiffness[k], eight.stiffness[k]);
}

} // namespace

Elements::Elements(const std::span<const unsigned int> nodes, std::vector<Corners> corners, const ElasticModuli &moduli)
    : corners_(std::move(corners)), moduli_(moduli), packs_((corners_.size() + points_per_pack - 1) / points_per_pack),
      volume_(corners_.size()), node_volume_(n_nodes * corners_.size())
{
  assert(nodes.size() == n_nodes * size());
  dof_of_node_.resize(n_nodes * points_per_pack * n_packs());
  for (std::size_t pack = 0; pack < n_packs(); ++pack)
    for (int node = 0; node < n_nodes; ++node)
      for (int lane = 0; lane < points_per_pack; ++lane)
        dof_of_node_[points_per_pack * (n_nodes * pack + node) + lane] =
            3 * nodes[n_nodes * element_of(pack, lane) + node];
  make_packs();
}

void Elements::set_share(const std::span<const double> nodal_share)
{
  nodal_share_.assign(nodal_share.begin(), nodal_share.end());
  make_packs();
}

std::array<double, n_points> Elements::share(const std::size_t element) const
{
  std::array<double, n_points> result;
  result.fill(1);
  if (nodal_share_.empty())
    return result;
  const std::size_t pack = element / points_per_pack, lane = element % points_per_pack;
  for (int point = 0; point < n_points; ++point)
  {
    result[point] = 0;
    for (int node = 0; node < n_nodes; ++node)
      result[point] += hexahedron::shape_value(node, point) *
                       nodal_share_[dof_of_node_[points_per_pack * (n_nodes * pack + node) + lane] / 3];
  }
  return result;
}

void Elements::make_packs()
{
  parallel_for(n_packs(), [&](const std::size_t pack) { make_pack(pack); });
}

void Elements::make_pack(const std::size_t pack)
{
  for (int lane = 0; lane < points_per_pack; ++lane)
  {
    const std::size_t element = element_of(pack, lane);
    const std::array<double, n_points> share = this->share(element);
    Geometry<double> one = make_geometry(corners_[element], moduli_, share);
    if (lane >= n_lanes(pack))
    {
      one.volume = 0;
      std::fill(std::begin(one.stiffness), std::end(one.stiffness), 0.);
    }
    for_each_number(one, packs_[pack], [&](const double from, Points &to) { to[lane] = from; });
    if (lane >= n_lanes(pack))
      continue;
    const GaussPoints points(corners_[element]);
    volume_[element] = 0;
    std::fill_n(&node_volume_[n_nodes * element], n_nodes, 0.);
    for (int point = 0; point < n_points; ++point)
    {
      volume_[element] += points.weight[point];
      for (int node = 0; node < n_nodes; ++node)
        node_volume_[n_nodes * element + node] +=
            hexahedron::shape_value(node, point) * share[point] * points.weight[point];
    }
  }
}

Geometry<double> Elements::geometry(const std::size_t element) const
{
  Geometry<double> one;
  const std::size_t lane = element % points_per_pack;
  for_each_number(one, packs_[element / points_per_pack], [&](double &to, const Points &from) { to = from[lane]; });
  return one;
}

} // namespace bergamo::fe::bending
