#include "fe_dealii/element/layered_elements.h"

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
    : ElementGroup(groups.front()->nodes_per_element(), nodes_of(groups, group_of_element)), groups_(std::move(groups))
{
  std::vector<std::size_t> next(groups_.size(), 0);
  for (const std::size_t group : group_of_element)
    place_.push_back({group, next[group]++});
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
  for (std::size_t first = begin; first < end;)
  {
    // Elements of one group that follow one another do so in the group, too.
    const Place place = place_[first];
    std::size_t last = first + 1;
    while (last < end && place_[last].group == place.group)
      ++last;
    const std::size_t n = last - first;
    ElementGroup &group = *groups_[place.group];
    const auto of_group = group.compute_forces(place.element, place.element + n, displacement, before);
    if (of_group && !failed)
      failed = first + (*of_group - place.element);
    std::copy_n(&group.forces()[dofs_per_element() * place.element], dofs_per_element() * n, force(first));
    first = last;
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
  return std::any_of(groups_.begin(), groups_.end(),
                     [](const auto &group) { return group->stiffens_with_displacement(); });
}

void LayeredElements::tangent(const std::size_t element, const double *displacement, const double *before,
                              double *matrix) const
{
  group_of(element).tangent(place_[element].element, displacement, before, matrix);
}

void LayeredElements::set_share(const std::span<const double> nodal_share)
{
  for (const auto &group : groups_)
    group->set_share(nodal_share);
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
  for (const auto &group : groups_)
    whole += ((*group).*energy)();
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
  for (std::size_t k = 0; k < groups_.size(); ++k)
    for (auto &[name, values] : groups_[k]->state())
      views.emplace_back("layer_" + std::to_string(k) + "_" + name, values);
  return views;
}

} // namespace bergamo::fe
