#pragma once

#include "fe_dealii/body_energy.h"
#include "fe_dealii/element/element_group.h"
#include "fe_dealii/material/initial_stress.h"
#include "fe_dealii/material/material.h"

#include <deal.II/lac/vector.h>

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
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
  unsigned int degree = 1;                ///< of the elements: 1 has 8 nodes, 2 has 27
  std::array<double, 3> gravity{0, 0, 0}; ///< [m/s²]
  double damping = 0;                     ///< α of the force −α m v [1/s], >= 0
  InitialStress initial_stress;           ///< at rest; none if empty. See make_solid_elements()

  /// Throws ParameterError.
  void validate() const;
};

/// A continuum body of hexahedra of one material, moved by the explicit leapfrog.
///
/// Global frame, SI units. Dof 3*node + component. Displacement, forces and stress live at whole steps, velocity at
/// half steps. One step:
///   clear_external_force(); others add to external_force(); compute_internal_force(); kick(dt); drift(dt);
/// Results are the same, bit for bit, on any number of threads.
class ExplicitBody
{
public:
  /// Copies the mesh. Throws ParameterError for bad parameters, an empty mesh, a mesh of anything but hexahedra,
  /// hanging nodes, cells turned inside out or an initial stress that the material does not bear.
  ExplicitBody(const dealii::Triangulation<3, 3> &mesh, const ExplicitBodyParameters &parameters);
  ExplicitBody(ExplicitBody &&) noexcept;
  ~ExplicitBody();

  /// @name One step
  /// @{

  /// Internal forces [N] and stresses of the present displacement; the strain increment is that since the last call.
  /// Throws AnalysisError, with its place, where an element has turned inside out.
  void compute_internal_force();

  /// v⁺ from v⁻ and the forces: m (v⁺ − v⁻)/dt = f_ext + m g − f_int − α m (v⁻ + v⁺)/2. The damping is centred: it adds
  /// no limit to the time step. Prescribed dofs take their velocity and get a reaction. dt [s] > 0.
  void kick(double dt);

  /// u += dt v⁺. Use the dt of the kick before.
  void drift(double dt);

  /// Takes the present displacement and stresses for a state of rest: no velocity, reactions that hold the prescribed
  /// dofs, accounts that start anew. Call after compute_internal_force().
  void rest();

  void clear_external_force() { external_force_ = 0; }
  /// @}

  /// @name Prescribed velocities
  /// A dof belongs to the first constraint that names it; later ones skip it. So prescribe what matters most first.
  /// @{

  using Constraint = std::size_t;

  /// Prescribes one velocity component [m/s] (0, 1, 2 = x, y, z) on all nodes of a boundary. Throws ParameterError for
  /// a boundary id that the mesh lacks or a component above 2.
  Constraint prescribe_velocity(unsigned int boundary_id, unsigned int component, double velocity = 0);

  /// The same for a list of nodes. Throws ParameterError for a node out of range.
  Constraint prescribe_velocity(std::span<const unsigned int> nodes, unsigned int component, double velocity = 0);

  void set_velocity(Constraint constraint, double velocity) { constraint_velocity_[constraint] = velocity; }

  double prescribed_velocity(Constraint constraint) const { return constraint_velocity_[constraint]; }
  /// The constraint of a dof, or nothing if it is free.
  std::optional<Constraint> constraint_of(std::size_t dof) const
  {
    return constraint_of_dof_[dof] < 0 ? std::nullopt : std::optional<Constraint>(constraint_of_dof_[dof]);
  }

  /// Resultant force that the boundary exerts on the body in the constrained component, at the last kick [N].
  double reaction(Constraint constraint) const;
  /// @}

  /// Share 1 − w of the continuum where particles carry the rest (Arlequin weight w, one per node, in [0, 1]):
  /// interpolated to the quadrature points, where it multiplies mass, internal force and gravity. Call before the first
  /// step. Throws ParameterError for a wrong length, a weight outside [0, 1], a node left without mass (bound the
  /// weights away from 1) or a material of large strain.
  void set_share(std::span<const double> nodal_weight);

  /// @name Nodal vectors, length 3 * n_nodes()
  /// @{
  dealii::Vector<double> &displacement() { return displacement_; }     ///< [m]
  dealii::Vector<double> &velocity() { return velocity_; }             ///< half step [m/s]
  dealii::Vector<double> &external_force() { return external_force_; } ///< [N], without gravity
  const dealii::Vector<double> &displacement() const { return displacement_; }
  const dealii::Vector<double> &velocity() const { return velocity_; }
  const dealii::Vector<double> &external_force() const { return external_force_; }
  const dealii::Vector<double> &internal_force() const { return internal_force_; } ///< [N]
  const dealii::Vector<double> &reaction_force() const { return reaction_force_; } ///< [N], zero at free dofs
  const dealii::Vector<double> &mass() const { return mass_; }                     ///< lumped, share included [kg]
  /// @}

  /// @name Mesh
  /// @{
  std::size_t n_nodes() const { return node_position_.size(); }
  std::size_t n_elements() const { return elements_->size(); }
  const std::vector<std::array<double, 3>> &node_position() const { return node_position_; } ///< reference [m]
  /// Nodes of an element, in deal.II's order of the element's shape functions: the corners first.
  std::span<const unsigned int> element_nodes(const std::size_t element) const { return elements_->nodes(element); }
  /// Nodes of a boundary, ascending; ParameterError where the mesh has no such boundary.
  std::vector<unsigned int> boundary_nodes(unsigned int boundary_id) const;
  /// Numbers the vectors above: FESystem(FE_Q(degree), 3) on the body's own copy of the mesh.
  const dealii::DoFHandler<3, 3> &dof_handler() const;
  /// @}

  /// @name Elements
  /// @{
  const ElementGroup &elements() const { return *elements_; }
  ElementGroup &elements() { return *elements_; }
  const std::array<double, 3> &gravity() const { return parameters_.gravity; } ///< [m/s²]
  double damping() const { return parameters_.damping; } ///< α [1/s]
  const Material &material() const { return parameters_.material; }
  ElementState state_of(const std::size_t element) const
  {
    return elements_->state_of(element, displacement_of_stress_.begin());
  }
  Stress average_stress() const; ///< volume average over the body, whatever the share
  /// @}

  /// Energies at the last kick. Call between a kick and the next compute_internal_force().
  BodyEnergy energy() const;
  double max_velocity() const; ///< greatest |v| of a node [m/s]
  bool is_finite() const;      ///< false once a displacement or velocity is NaN or infinite

  /// Everything that changes from step to step, by name, as views. Restoring the values in a body that was set up in
  /// the same way (mesh, parameters, constraints, share) goes on with the same bits.
  std::vector<std::pair<std::string, std::span<double>>> state();

private:
  struct Mesh;

  void gather_mass();
  [[noreturn]] void report_inversion(std::size_t element) const;

  std::unique_ptr<Mesh> mesh_;
  ExplicitBodyParameters parameters_;

  std::vector<std::array<double, 3>> node_position_;
  std::unique_ptr<ElementGroup> elements_;
  std::vector<std::size_t> slot_head_; // slots of node i: slot_[slot_head_[i]] .. slot_[slot_head_[i + 1]]
  std::vector<unsigned int> slot_;     // places of the node in elements_->nodes(), ascending

  dealii::Vector<double> displacement_, velocity_, internal_force_, external_force_, reaction_force_, mass_;
  dealii::Vector<double> displacement_of_stress_; // where the stresses were computed last

  std::vector<int> constraint_of_dof_; // −1: free
  std::vector<std::vector<unsigned int>> constraint_dofs_;
  std::vector<double> constraint_velocity_;

  struct Work // accumulated, trapezoidal
  {
    double external = 0, gravity = 0, boundary = 0, viscous = 0;
  };
  struct Ledger // doubles only: it is part of the state
  {
    Work here;  // up to the last kick
    Work ahead; // the same plus the half of the coming drift that the last kick's forces do
    double kinetic = 0;
    double initial = 0;
    double last_step = 0; // dt of the last kick [s], 0 before the first
  };
  Ledger ledger_;
};

} // namespace bergamo::fe
