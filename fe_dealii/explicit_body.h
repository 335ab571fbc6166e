#pragma once

#include "fe_dealii/element/solid_elements.h"
#include "fe_dealii/material/initial_stress.h"
#include "fe_dealii/material/material.h"
#include "fe_dealii/mesh/box_mesh.h"
#include "fe_dealii/moving_body.h"

#include <array>
#include <map>
#include <memory>
#include <span>
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

struct ExplicitBodyParameters
{
  Material material = MohrCoulomb(MohrCoulombParameters());
  std::map<unsigned int, Material> layers; ///< by the material ids of the mesh's cells; none: `material` everywhere
  unsigned int degree = 1;                 ///< of the elements: 1 has 8 nodes, 2 has 27
  SolidKind kind;                          ///< of the elements
  std::array<double, 3> gravity{0, 0, 0};  ///< [m/s²]
  double damping = 0;                      ///< α of the force −α m v [1/s], >= 0
  InitialStress initial_stress;            ///< at rest; none if empty. See make_solid_elements()
  /// Mass scaling: an element whose own stable step at the start is shorter than this [s] gets its inertia multiplied
  /// until it is as long. Its weight stays. 0: none, >= 0. Slow motions stay true where mass_scaling().share is small;
  /// a body that stiffens later may need a shorter step again (stable_step()).
  double wanted_time_step = 0;

  /// Throws ConfigError.
  void validate() const;
};

/// A continuum body of hexahedra of one material or several; see MovingBody for its motion.
class ExplicitBody : public MovingBody
{
public:
  /// Copies the mesh. Throws ConfigError for bad parameters, an empty mesh, a mesh of anything but hexahedra,
  /// hanging nodes, cells turned inside out, a cell whose material id has no layer, a layer without cells, or an
  /// initial stress that the material does not bear.
  ExplicitBody(const dealii::Triangulation<3, 3> &mesh, const ExplicitBodyParameters &parameters);
  ExplicitBody(ExplicitBody &&) noexcept;
  ~ExplicitBody() override;

  /// Share 1 − w of the continuum where particles carry the rest (Arlequin weight w, one per node, in [0, 1]):
  /// interpolated to the quadrature points, where it multiplies mass, internal force and gravity. Elements of which all
  /// nodes have w = 1 are absent: they have no forces, and nodes that have no others stay where they are. May be called
  /// again between steps, with weights that leave no element absent that is not so already to come back; the energy
  /// that this takes out is booked as if it had never been there. Throws ConfigError for a wrong length, a weight
  /// outside [0, 1], a body left without elements, an absent element that would come back, or a material of large
  /// strain.
  void set_share(std::span<const double> nodal_weight);
  bool is_absent(const std::size_t element) const { return !is_absent_.empty() && is_absent_[element]; }

  std::vector<unsigned int> boundary_nodes(unsigned int boundary_id) const override;
  /// Numbers the vectors of the body: FESystem(FE_Q(degree), 3) on the body's own copy of the mesh.
  const dealii::DoFHandler<3, 3> &dof_handler() const;
  const Material &material(std::size_t element = 0) const;
  /// Of the mesh's cell; read_mesh() takes it from the file, set_material() from boxes.
  unsigned int material_id(const std::size_t element) const { return material_id_[element]; }

private:
  struct Mesh;
  ExplicitBody(std::unique_ptr<Mesh> mesh, const ExplicitBodyParameters &parameters);

  std::unique_ptr<Mesh> mesh_;
  std::vector<unsigned int> material_id_;      // of the elements
  std::map<unsigned int, Material> materials_; // by id
  std::vector<bool> is_absent_;                // of the elements; none where none is
};

/// A body on the mesh that make_box() makes. Throws ConfigError for what either does not allow.
ExplicitBody make_box_body(const BoxMeshParameters &box, const ExplicitBodyParameters &parameters);

} // namespace bergamo::fe
