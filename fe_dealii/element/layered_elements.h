#pragma once

#include "fe_dealii/element/element_group.h"

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace bergamo::fe
{

/// Elements of several laws as one group: each law has a group of its own, and what these compute is put in the order
/// of the body's elements. So the nodes add up forces in the same order whatever the laws, and layers of one material
/// are the homogeneous body, bit for bit; only the energies are summed group by group. Forces are computed one group
/// after the other, each from a multiple of eight on: elements of one law may share a pack, which is one call's then.
class LayeredElements final : public ElementGroup
{
public:
  /// @param groups of the same shape, not empty
  /// @param group_of_element of the body: the k-th element that names a group is that group's k-th one
  LayeredElements(std::vector<std::unique_ptr<ElementGroup>> groups, std::span<const std::size_t> group_of_element);

  void make_rigid(std::size_t element) override;
  std::size_t n_places() const override;
  std::optional<std::size_t> compute_forces(std::size_t begin, std::size_t end, const double *displacement,
                                            const double *before) override;
  std::string failure(std::size_t element) const override;
  void lumped_mass(std::size_t element, double *mass) const override;
  void gravitational_mass(std::size_t element, double *mass) const override;
  void stiffness(std::size_t element, const double *displacement, double *matrix) const override;
  double stiffness_factor(std::size_t element) const override;
  bool stiffens_with_displacement() const override;
  bool has_symmetric_tangent() const override;
  bool bends() const override;
  void tangent(std::size_t element, const double *displacement, const double *before, double *matrix) const override;
  void set_share(std::span<const double> nodal_share) override;
  double volume(std::size_t element) const override;
  ElementState state_of(std::size_t element, const double *displacement) const override;
  double elastic_energy() const override;
  double dissipated_energy() const override;
  double stiffness_loss() const override;
  std::vector<std::pair<std::string, std::span<double>>> state() override;

private:
  struct Layer
  {
    std::unique_ptr<ElementGroup> group;
    std::vector<std::size_t> element; // of the body, by those of the group
    std::size_t first_place;
  };
  struct Place
  {
    std::size_t layer, element; // of its group
  };
  template <class Energy>
  double sum(Energy energy) const;

  ElementGroup &group_of(const std::size_t element) const { return *layers_[place_[element].layer].group; }

  std::vector<Layer> layers_;
  std::vector<Place> place_; // of each element of the body
};

} // namespace bergamo::fe
