#include "coupling/adapter/stress_profile.h"

#include "dem/core/error.h"
#include "dem/measure/contact_list.h"

#include <algorithm>
#include <cmath>

namespace bergamo::coupling
{
namespace
{

/// Part of the way from one height to another that lies in a slab.
double part_inside(const SlabStress &slab, const double from, const double to)
{
  const double low = std::min(from, to), high = std::max(from, to);
  if (high == low)
    return low >= slab.low && low < slab.high ? 1. : 0.;
  return std::max(0., std::min(high, slab.high) - std::max(low, slab.low)) / (high - low);
}

class Slabs
{
public:
  Slabs(const dem::Box &box, const unsigned int n) : bottom(box.low[2]), height(box.edges()[2] / n), slabs(n)
  {
    if (n == 0)
      reject("a profile of stresses has 0 slabs; give it as many as there are layers of elements");
    for (unsigned int k = 0; k < n; ++k)
    {
      slabs[k].low = bottom + k * height;
      slabs[k].high = bottom + (k + 1) * height;
    }
    volume = box.volume() / n;
  }

  /// Shares out a stress times volume [N m] that is even between two heights.
  void add(Vec3 SlabStress::*model, const double from, const double to, const Vec3 &stress_volume)
  {
    const auto number_of = [&](const double z)
    { return std::clamp(static_cast<int>(std::floor((z - bottom) / height)), 0, static_cast<int>(slabs.size()) - 1); };
    const int first = number_of(std::min(from, to)), last = number_of(std::max(from, to));
    for (int k = first; k <= last; ++k)
      slabs[k].*model += part_inside(slabs[k], from, to) / volume * stress_volume;
  }

  std::vector<SlabStress> all() && { return std::move(slabs); }

private:
  double bottom, height, volume;
  std::vector<SlabStress> slabs;
};

void add_grains(Slabs &slabs, const dem::Simulation &grains)
{
  const dem::Particles &p = grains.particles;
  for (const auto &some : {grains.contacts.touching(p), grains.contacts.touching_walls(p)})
    for (const dem::TouchingContact &c : some)
    {
      const double from = p.position[c.first][2], to = from + c.branch[2];
      slabs.add(&SlabStress::grains, from, to, c.branch.cwiseProduct(dem::force_on_body1(c)));
    }
}

void add_continuum(Slabs &slabs, const fe::ExplicitBody &body, const std::vector<double> &share)
{
  for (std::size_t element = 0; element < body.n_elements(); ++element)
  {
    double low = 1e300, high = -1e300, mean_share = 0.;
    const auto nodes = body.element_nodes(element);
    for (const unsigned int node : nodes)
    {
      low = std::min(low, body.node_position()[node][2]);
      high = std::max(high, body.node_position()[node][2]);
      mean_share += share[node] / static_cast<double>(nodes.size());
    }
    const auto &stress = body.state_of(element).stress;
    slabs.add(&SlabStress::continuum, low, high,
              mean_share * body.elements().volume(element) * Vec3(stress[0], stress[1], stress[2]));
  }
}

} // namespace

std::vector<SlabStress> stress_profile(const TwoScaleModel &model, const dem::Box &box, const unsigned int n_slabs)
{
  Slabs slabs(box, n_slabs);
  if (model.grains())
    add_grains(slabs, *model.grains());
  if (model.body())
  {
    std::vector<double> share(model.body()->n_nodes(), 1.);
    for (std::size_t node = 0; node < model.weight_of_grains().size(); ++node)
      share[node] -= model.weight_of_grains()[node];
    add_continuum(slabs, *model.body(), share);
  }
  return std::move(slabs).all();
}

std::vector<SlabStress> stress_profile(const dem::Simulation &grains, const dem::Box &box, const unsigned int n_slabs)
{
  Slabs slabs(box, n_slabs);
  add_grains(slabs, grains);
  return std::move(slabs).all();
}

double unevenness(const std::vector<SlabStress> &profile)
{
  double least = 1e300, most = -1e300, sum = 0.;
  for (const SlabStress &slab : profile)
  {
    const double stress = slab.total()[2];
    least = std::min(least, stress);
    most = std::max(most, stress);
    sum += stress;
  }
  return sum == 0. ? 0. : (most - least) / std::abs(sum / static_cast<double>(profile.size()));
}

} // namespace bergamo::coupling
