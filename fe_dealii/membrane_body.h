#pragma once

#include "fe_dealii/element/membrane_elements.h"
#include "fe_dealii/moving_body.h"

#include <array>
#include <memory>
#include <vector>

namespace dealii
{
template <int dim, int spacedim>
class DoFHandler;
template <int dim, int spacedim>
class Triangulation;
} // namespace dealii

namespace bergamo::fe
{

struct MembraneBodyParameters
{
  Rubber material = NeoHooke(ElasticParameters{.young_modulus = 1.5e6, .poisson_ratio = 0.49, .density = 1000});
  double thickness = 1e-3;                ///< in the reference configuration [m], > 0
  std::array<double, 3> gravity{0, 0, 0}; ///< [m/s²]
  double damping = 0;                     ///< α of the force −α m v [1/s], >= 0

  /// Throws ConfigError.
  void validate() const;
};

/// A body of rubber membranes of four nodes, of constant volume and without bending stiffness; see MovingBody for its
/// motion. Slack parts fold without resistance: damp or stretch them. Pressures act on membrane_surface().
class MembraneBody : public MovingBody
{
public:
  /// Copies the mesh, which may be open or closed. Throws ConfigError for bad parameters, an empty mesh, a mesh of
  /// anything but quadrilaterals, hanging nodes, degenerate cells or cells that are folded over.
  MembraneBody(const dealii::Triangulation<2, 3> &mesh, const MembraneBodyParameters &parameters);
  MembraneBody(MembraneBody &&) noexcept;
  ~MembraneBody() override;

  std::vector<unsigned int> boundary_nodes(unsigned int boundary_id) const override;
  /// Numbers the vectors of the body: FESystem(FE_Q(1), 3) on the body's own copy of the mesh.
  const dealii::DoFHandler<2, 3> &dof_handler() const;
  MembraneState membrane_state_of(const std::size_t element) const
  {
    return membranes_->membrane_state_of(element, displacement_of_stress().data());
  }

private:
  struct Mesh;
  MembraneBody(std::unique_ptr<Mesh> mesh, const MembraneBodyParameters &parameters);

  std::unique_ptr<Mesh> mesh_;
  const MembraneElements *membranes_; // what elements() are
};

} // namespace bergamo::fe
