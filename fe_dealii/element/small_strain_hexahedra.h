#pragma once

#include "fe_dealii/element/hexahedron.h"
#include "fe_dealii/element/small_strain_elements.h"
#include "fe_dealii/element/start_force.h"

namespace bergamo::fe
{

/// Trilinear hexahedra with a mean dilatation at small strain, see hexahedron.h. Stresses at the start count point by
/// point: the mean dilatation would see their mean over the element alone, and ground at rest under its weight would be
/// out of balance on a mesh that is no bricks. What that adds is a constant force.
template <class Law>
class SmallStrainHexahedra : public SmallStrainElements<Law>
{
public:
  /// @param start see SmallStrainElements
  SmallStrainHexahedra(const Law &law, std::vector<unsigned int> nodes, std::vector<hexahedron::Geometry> geometry,
                       std::vector<typename SmallStrainElements<Law>::History> start);

  std::optional<std::size_t> compute_forces(std::size_t begin, std::size_t end, const double *displacement,
                                            const double *before) override;
  void lumped_mass(std::size_t element, double *mass) const override;
  void stiffness(std::size_t element, const double *displacement, double *matrix) const override;
  void tangent(std::size_t element, const double *displacement, const double *before, double *matrix) const override;
  void set_share(std::span<const double> nodal_share) override;
  bool bends() const override { return false; }
  double elastic_energy() const override;
  std::vector<std::pair<std::string, std::span<double>>> state() override;

  const hexahedron::Geometry &geometry(const std::size_t element) const { return geometry_[element]; }

protected:
  /// Adds what the stresses at the start have beyond their means. @param u displacement of the element [m]
  void add_start_force(const std::size_t element, const double *u)
  {
    if (!start_force_.is_empty())
      start_force_.add(element, u, this->force(element));
  }

  /// stiffness() of an element of this shape.
  void elastic_stiffness(std::size_t element, const hexahedron::Geometry &shape, double *matrix) const;

private:
  double point_volume(const std::size_t element, const int point) const override
  {
    return geometry_[element].volume[point];
  }
  double point_share_volume(const std::size_t element, const int point) const override
  {
    return geometry_[element].share_volume[point];
  }

  /// From the stresses at the points, which are those at the start.
  void find_start_force();

  std::vector<hexahedron::Geometry> geometry_;
  struct StartStress
  {
    Points component[6]; // [Pa]
  };
  std::vector<StartStress> start_stress_; // of each element; none where it is even in all
  StartForce start_force_;                // unevenness_force() of it
};

extern template class SmallStrainHexahedra<LinearElastic>;
extern template class SmallStrainHexahedra<MohrCoulomb>;
extern template class SmallStrainHexahedra<HypoplasticSand>;

} // namespace bergamo::fe
