#include "fe_dealii/element/layered_elements.h"

#include "fe_dealii/element/points.h"

#include <algorithm>

namespace bergamo::fe
{
namespace
{

/// Nodes of all elements in the order of the body.
std::vector<unsigned int> nodes_of(const std::vector<std::unique_ptr<ElementGroup>> &groups,
                                   const std::span<const std::size_t> group_of_element)
{
  std::vector<std::size_t> next(groups.size(), 0);
  std::vector<unsigned int> nodes;
  for (const std::size_t group : group_of_element)
  {
    const std::span<const unsigned int> own = groups[group]->nodes(next[group]++);
    nodes.insert(nodes.end(), own.begin(), own.end());
  }
  return nodes;
}

} // namespace

LayeredElements::LayeredElements(std::vector<std::unique_ptr<ElementGroup>> groups,
                                 const std::span<const std::size_t> group_of_element)
    : ElementGroup(groups.front()->nodes_per_element(), nodes_of(groups, group_of_element))
{
  for (auto &group : groups)
  {
    const std::size_t first = (n_places() + points_per_pack - 1) / points_per_pack * points_per_pack;
    layers_.push_back({std::move(group), {}, first});
  }
  for (const std::size_t layer : group_of_element)
  {
    place_.push_back({layer, layers_[layer].element.size()});
    layers_[layer].element.push_back(place_.size() - 1);
  }
}

std::size_t LayeredElements::n_places() const
{
  return layers_.empty() ? 0 : layers_.back().first_place + layers_.back().group->size();
}

void LayeredElements::make_rigid(const std::size_t element)
{
  ElementGroup::make_rigid(element);
  group_of(element).make_rigid(place_[element].element);
}

std::optional<std::size_t> LayeredElements::compute_forces(const std::size_t begin, const std::size_t end,
                                                           const double *displacement, const double *before)
{
  std::optional<std::size_t> failed;
  for (const Layer &layer : layers_)
  {
    const std::size_t first = std::max(begin, layer.first_place);
    const std::size_t last = std::min(end, layer.first_place + layer.group->size());
    if (first >= last)
      continue;
    const auto of_group =
        layer.group->compute_forces(first - layer.first_place, last - layer.first_place, displacement, before);
    if (of_group)
      failed = std::min(layer.element[*of_group], failed.value_or(size()));
    for (std::size_t e = first - layer.first_place; e < last - layer.first_place; ++e)
      std::copy_n(&layer.group->forces()[dofs_per_element() * e], dofs_per_element(), force(layer.element[e]));
  }
  return failed;
}

std::string LayeredElements::failure(const std::size_t element) const
{
  return group_of(element).failure(place_[element].element);
}

void LayeredElements::lumped_mass(const std::size_t element, double *mass) const
{
  group_of(element).lumped_mass(place_[element].element, mass);
}

void LayeredElements::gravitational_mass(const std::size_t element, double *mass) const
{
  group_of(element).gravitational_mass(place_[element].element, mass);
}

void LayeredElements::stiffness(const std::size_t element, const double *displacement, double *matrix) const
{
  group_of(element).stiffness(place_[element].element, displacement, matrix);
}

double LayeredElements::stiffness_factor(const std::size_t element) const
{
  return group_of(element).stiffness_factor(place_[element].element);
}

bool LayeredElements::stiffens_with_displacement() const
{
  return std::any_of(layers_.begin(), layers_.end(),
                     [](const Layer &layer) { return layer.group->stiffens_with_displacement(); });
}

bool LayeredElements::has_symmetric_tangent() const
{
  return std::all_of(layers_.begin(), layers_.end(),
                     [](const Layer &layer) { return layer.group->has_symmetric_tangent(); });
}

bool LayeredElements::bends() const
{
  return std::all_of(layers_.begin(), layers_.end(), [](const Layer &layer) { return layer.group->bends(); });
}

void LayeredElements::tangent(const std::size_t element, const double *displacement, const double *before,
                              double *matrix) const
{
  group_of(element).tangent(place_[element].element, displacement, before, matrix);
}

void LayeredElements::set_share(const std::span<const double> nodal_share)
{
  for (const Layer &layer : layers_)
    layer.group->set_share(nodal_share);
}

double LayeredElements::volume(const std::size_t element) const
{
  return group_of(element).volume(place_[element].element);
}

ElementState LayeredElements::state_of(const std::size_t element, const double *displacement) const
{
  return group_of(element).state_of(place_[element].element, displacement);
}

template <class Energy>
double LayeredElements::sum(const Energy energy) const
{
  double whole = 0;
  for (const Layer &layer : layers_)
    whole += ((*layer.group).*energy)();
  return whole;
}

double LayeredElements::elastic_energy() const
{
  return sum(&ElementGroup::elastic_energy);
}

double LayeredElements::dissipated_energy() const
{
  return sum(&ElementGroup::dissipated_energy);
}

double LayeredElements::stiffness_loss() const
{
  return sum(&ElementGroup::stiffness_loss);
}

std::vector<std::pair<std::string, std::span<double>>> LayeredElements::state()
{
  std::vector<std::pair<std::string, std::span<double>>> views;
  for (std::size_t k = 0; k < layers_.size(); ++k)
    for (auto &[name, values] : layers_[k].group->state())
      views.emplace_back("layer_" + std::to_string(k) + "_" + name, values);
  return views;
}

} // namespace bergamo::fe
