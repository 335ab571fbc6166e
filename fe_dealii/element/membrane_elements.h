#pragma once

#include "fe_dealii/element/element_group.h"
#include "fe_dealii/element/membrane.h"
#include "fe_dealii/material/mooney_rivlin.h"
#include "fe_dealii/material/neo_hooke.h"
#include "fe_dealii/material/ogden.h"

#include <array>
#include <memory>
#include <variant>

namespace dealii
{
template <int dim, int spacedim>
class DoFHandler;
}

namespace bergamo::fe
{

/// The law of a membrane. Membranes keep their volume, so the bulk modulus or Poisson's ratio of the law beyond its
/// shear modulus counts for nothing.
using Rubber = std::variant<NeoHooke, MooneyRivlin, Ogden>;

/// A membrane element's mean state, for output.
struct MembraneState
{
  std::array<double, 2> principal_stress{}; ///< Cauchy, in the plane, the greater first; mean over the volume [Pa]
  double thickness = 0;                     ///< volume over present area [m]
};

/// Membranes of four nodes, see membrane.h.
class MembraneElements final : public ElementGroup
{
public:
  /// @param nodes four an element; @param thickness in the reference configuration [m]
  MembraneElements(const Rubber &law, std::vector<unsigned int> nodes, std::vector<membrane::Geometry> geometry,
                   double thickness);

  std::optional<std::size_t> compute_forces(std::size_t begin, std::size_t end, const double *displacement,
                                            const double *before) override;
  void lumped_mass(std::size_t element, double *mass) const override;
  /// Of the present state: a flat membrane without stress has none across its plane, a compressed one less than none.
  void stiffness(std::size_t element, const double *displacement, double *matrix) const override;
  bool stiffens_with_displacement() const override { return true; }
  void tangent(const std::size_t element, const double *displacement, const double *, double *matrix) const override
  {
    stiffness(element, displacement, matrix);
  }
  void set_share(std::span<const double> nodal_share) override;
  double volume(const std::size_t element) const override { return math::sum(geometry_[element].volume); }
  ElementState state_of(std::size_t element, const double *displacement) const override;
  MembraneState membrane_state_of(std::size_t element, const double *displacement) const;
  double elastic_energy() const override;
  double dissipated_energy() const override { return 0; }
  std::vector<std::pair<std::string, std::span<double>>> state() override { return {{"element_energy", energy_}}; }

private:
  Rubber law_;
  std::vector<membrane::Geometry> geometry_;
  double thickness_;
  std::vector<double> energy_; // of each element at the last compute_forces()
};

/// The membranes on all active cells, in their order.
/// @param dof_handler of an FESystem(FE_Q(1), 3) on quadrilaterals; @param thickness > 0 [m]
/// @throws ConfigError for a cell that is degenerate or folded over
std::unique_ptr<MembraneElements> make_membrane_elements(const dealii::DoFHandler<2, 3> &dof_handler, const Rubber &law,
                                                         double thickness);

} // namespace bergamo::fe
