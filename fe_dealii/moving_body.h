#pragma once

#include "dem/core/index.h"
#include "dem/core/rows.h"
#include "fe_dealii/body_energy.h"
#include "fe_dealii/boundary/dashpots.h"
#include "fe_dealii/boundary/node_images.h"
#include "fe_dealii/element/element_group.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace bergamo::fe
{

/// What acts on every node of a body in proportion to its mass.
struct MassForces
{
  std::array<double, 3> gravity{0, 0, 0}; ///< [m/s²]
  double damping = 0;                     ///< α of the force −α m v [1/s], >= 0

  /// Throws ConfigError. @param body what the message begins with
  void validate(const std::string &body) const;
};

/// What mass scaling added to a body.
struct MassScaling
{
  double added_mass = 0;      ///< [kg]
  double share = 0;           ///< added over the body's true mass [-]
  std::size_t n_elements = 0; ///< that were scaled
  double largest_factor = 1;  ///< of an element's mass [-]
};

/// Nodes and elements moved by the explicit leapfrog; ExplicitBody and MembraneBody add the mesh.
///
/// Global frame, SI units. Dof 3*node + component. Displacement, forces and stress live at whole steps, velocity at
/// half steps. One step, forces · kick · [read] · drift:
///   clear_external_force(); others add to external_force(); compute_internal_force(); kick(dt); drift(dt);
/// dt may change from step to step. Reading changes nothing, nor does asking for the forces again. Results are the
/// same, bit for bit, on any number of threads.
class MovingBody
{
public:
  virtual ~MovingBody();

  /// @name One step
  /// @{

  /// Internal forces [N] and stresses of the present displacement; the strain increment is that since the last call,
  /// and none is made where nothing has moved since. Throws RunError, with its place and the time, where an element has
  /// turned inside out or has forces that are not finite.
  void compute_internal_force();

  /// v⁺ from v⁻ and the forces: m (v⁺ − v⁻)/h = f_ext + weight − f_int − α m (v⁻ + v⁺)/2 with h = kick_time(dt). The
  /// damping is centred: it adds no limit to the time step. Prescribed dofs take their velocity and get a reaction.
  /// @param dt of the step to come [s]; ConfigError unless it is positive and finite
  /// Throws RunError for a second kick without a drift in between, which would accelerate the body twice, with place
  /// and time where a load or a motion is not finite, and for a first step of a body with dashpots that rest() has not
  /// been called for.
  void kick(double dt);

  /// u += dt v⁺. Throws RunError unless a kick with the same dt came before.
  void drift(double dt);

  /// Time over which a kick before a step dt acts [s]: the mean of the last step and the one to come, since the
  /// velocities live in the middle of both. The first step counts as one after its like.
  double kick_time(const double dt) const { return ledger_.last_step > 0 ? 0.5 * (ledger_.last_step + dt) : dt; }

  /// Number of drifts so far.
  std::int64_t n_steps() const { return static_cast<std::int64_t>(progress_.n_steps); }

  double time() const { return progress_.time; } ///< sum of the drifts so far [s]

  /// Takes the present displacement and stresses for a state of rest: no velocity, reactions that hold the prescribed
  /// dofs, accounts that start anew. Call after compute_internal_force().
  void rest();

  void clear_external_force() { external_force_.assign(external_force_.size(), 0.); }
  /// @}

  /// @name Prescribed velocities
  /// A dof belongs to the first constraint that names it; later ones skip it. So prescribe what matters most first.
  /// @{

  using Constraint = Index<struct ConstraintList>;

  /// Prescribes one velocity component [m/s] (0, 1, 2 = x, y, z) on all nodes of a boundary. Throws ConfigError for
  /// a boundary id that the mesh lacks or a component above 2.
  Constraint prescribe_velocity(unsigned int boundary_id, unsigned int component, double velocity = 0);

  /// The same for a list of nodes. Throws ConfigError for a node out of range.
  Constraint prescribe_velocity(std::span<const unsigned int> nodes, unsigned int component, double velocity = 0);

  void set_velocity(Constraint constraint, double velocity) { constraint_velocity_[constraint.place()] = velocity; }

  double prescribed_velocity(Constraint constraint) const { return constraint_velocity_[constraint.place()]; }
  /// The constraint of a dof, or nothing if it is free.
  std::optional<Constraint> constraint_of(std::size_t dof) const
  {
    return constraint_of_dof_[dof] < 0 ? std::nullopt : std::optional(Constraint(constraint_of_dof_[dof]));
  }

  /// Puts dashpots between nodes and the ground: −C v on the node, with C of the element's present stiffness and
  /// inertia (times sqrt(stiffness_factor · mass_factor)). Like the damping they are centred in time, node by node, and
  /// add no limit to the time step. Until the first kick they hold the dofs of their nodes that no constraint names, as
  /// walls would, so that the body can be brought to rest; the forces with which they hold at rest() stay as dead
  /// loads. Throws ConfigError for a node or element out of range, and for a body that has moved.
  void add_dashpots(std::span<const Dashpot> dashpots);

  /// Dead load that dashpots' hold has left on a free dof [N].
  double held_force(const std::size_t dof) const
  {
    return held_force_.empty() || constraint_of_dof_[dof] >= 0 ? 0 : held_force_[dof];
  }

  /// C v of a node's dashpots at its present velocity, with the viscosity of the last kick; none without [N].
  std::array<double, 3> drag(std::size_t node) const;

  /// Elements whose nodes are all among these move as one rigid body, see ElementGroup::is_rigid().
  void make_rigid(std::span<const unsigned int> nodes);

  /// Resultant force that the boundary exerts on the body in the constrained component, at the last kick [N].
  double reaction(Constraint constraint) const;
  /// @}

  /// @name A body that repeats itself
  /// Nodes at the same place of opposite faces are images of one another: they get the forces of all of them together.
  /// @{

  /// Along directions of the global frame, before any velocity is prescribed or dashpot put. A velocity that is
  /// prescribed at one of these nodes is so at its images. Throws ConfigError where opposite faces are not meshed
  /// alike, or for a body with prescribed velocities or dashpots.
  void repeat(std::array<bool, 3> is_periodic);

  /// Of the upper faces against the lower ones [m/s]; along directions that do not repeat themselves it says nothing.
  void set_face_velocity(const std::array<double, 3> &velocity);

  const NodeImages &images() const { return images_; }

  /// Force on the upper face of a direction from its surroundings, as the last kick had it, opposite to that on the
  /// lower one: the body's mean stress there times the area [N].
  std::array<double, 3> face_force(std::size_t direction) const;
  /// @}

  /// @name Nodal vectors, length 3 * n_nodes()
  /// @{
  std::span<double> displacement() { return displacement_; }     ///< [m]
  std::span<double> velocity() { return velocity_; }             ///< half step [m/s]
  std::span<double> external_force() { return external_force_; } ///< [N], without gravity
  std::span<const double> displacement() const { return displacement_; }
  std::span<const double> velocity() const { return velocity_; }
  std::span<const double> external_force() const { return external_force_; }
  std::span<const double> internal_force() const { return internal_force_; } ///< [N]
  std::span<const double> reaction_force() const { return reaction_force_; } ///< [N], zero at free dofs
  std::span<const double> mass() const { return mass_; } ///< inertia, lumped, share and scaling included [kg]
  /// Force of gravity on a dof, ∫ N ρ g dV of the true mass whatever its scaling and lumping [N].
  double weight(const std::size_t dof) const { return gravitational_mass_[dof / 3] * forces_.gravity[dof % 3]; }
  /// @}

  /// @name Nodes and elements
  /// @{
  std::size_t n_nodes() const { return node_position_.size(); }
  std::size_t n_elements() const { return elements_->size(); }
  const std::vector<std::array<double, 3>> &node_position() const { return node_position_; } ///< reference [m]
  /// Nodes of an element, in deal.II's order of the element's shape functions: the corners first.
  std::span<const unsigned int> element_nodes(const std::size_t element) const { return elements_->nodes(element); }
  /// Nodes of a boundary, ascending; ConfigError where the mesh has no such boundary.
  virtual std::vector<unsigned int> boundary_nodes(unsigned int boundary_id) const = 0;
  const ElementGroup &elements() const { return *elements_; }
  ElementGroup &elements() { return *elements_; }
  const std::array<double, 3> &gravity() const { return forces_.gravity; } ///< [m/s²]
  double damping() const { return forces_.damping; }                       ///< α [1/s]
  ElementState state_of(const std::size_t element) const
  {
    return elements_->state_of(element, displacement_of_stress_.data());
  }
  Stress average_stress() const;                                   ///< volume average over the body, whatever the share
  std::array<double, 3> present_centre(std::size_t element) const; ///< mean of its nodes' places [m]
  std::array<double, 3> reference_centre(std::size_t element) const; ///< the same where the body started [m]
  /// "NAME: element E at (x, y, z) m has, at time t s,": what the message of a failing run begins with.
  std::string describe(std::size_t element) const;
  /// Factor of an element's inertia; 1 where it is not scaled.
  double mass_factor(const std::size_t element) const { return mass_factor_.empty() ? 1 : mass_factor_[element]; }
  const MassScaling &mass_scaling() const { return mass_scaling_; }
  /// @}

  /// Energies at the last kick. Call between a kick and the next compute_internal_force().
  BodyEnergy energy() const;
  double max_velocity() const; ///< greatest |v| of a node [m/s]
  bool is_finite() const;      ///< false once a displacement or velocity is NaN or infinite

  /// Everything that changes from step to step, by name, as views. Restoring the values in a body that was set up in
  /// the same way (mesh, parameters, constraints, share) goes on with the same bits.
  std::vector<std::pair<std::string, std::span<double>>> state();

protected:
  /// @param name what messages begin with
  /// @param wanted_time_step elements that bear less [s] get as much inertia as that takes; 0: none does
  MovingBody(std::string name, std::vector<std::array<double, 3>> node_position, std::unique_ptr<ElementGroup> elements,
             const MassForces &forces, double wanted_time_step);
  MovingBody(MovingBody &&) noexcept;

  /// Masses of the nodes from those of the elements; again after these have changed.
  void gather_mass();

  /// Changes what the elements are, with the masses that follow, at the present displacement; of a body that has moved
  /// it books the energy which comes or goes with it.
  void exchange(const std::function<void()> &change);

  std::span<const double> displacement_of_stress() const { return displacement_of_stress_; }
  const std::string &name() const { return name_; }

private:
  void scale_mass();
  double present_energy() const;
  bool is_held_by_dashpots(const std::size_t dof) const
  {
    return hold_ && constraint_of_dof_[dof] == static_cast<int>(hold_->place());
  }
  void let_go_of_dashpots();
  [[noreturn]] void report_failure(std::size_t element) const;
  [[noreturn]] void report_endless_forces() const;
  [[noreturn]] void report_endless_motion() const;

  std::string name_;
  MassForces forces_;
  double wanted_time_step_;
  std::vector<std::array<double, 3>> node_position_;
  std::unique_ptr<ElementGroup> elements_;
  Rows<unsigned int> slots_; // places of each node in elements_->nodes(), ascending

  std::vector<double> displacement_, velocity_, internal_force_, external_force_, reaction_force_, mass_;
  std::vector<double> gravitational_mass_;     // of the nodes, see ElementGroup
  std::vector<double> displacement_of_stress_; // where the stresses were computed last

  std::vector<double> mass_factor_; // of the elements; none where nothing is scaled
  MassScaling mass_scaling_;

  std::vector<int> constraint_of_dof_; // −1: free
  std::vector<std::vector<unsigned int>> constraint_dofs_;
  std::vector<double> constraint_velocity_;

  NodeImages images_;
  std::array<double, 3> face_velocity_{}; // of upper faces against lower ones [m/s]
  std::vector<double> imaged_velocity_;   // of nodes with images after the kick, by degree of freedom [m/s]

  Dashpots dashpots_;
  std::optional<Constraint> hold_; // of the dashpots until the first kick
  std::vector<double> held_force_; // of all dofs; none without dashpots

  struct Work // accumulated, trapezoidal
  {
    double external = 0, gravity = 0, boundary = 0, viscous = 0, radiated = 0, step_change = 0;

    void add(const Work &part);
  };
  struct Ledger // doubles only: it is part of the state
  {
    Work here;  // up to the last kick
    Work ahead; // the same plus the half of the coming drift that the last kick's forces do
    double kinetic = 0;
    double initial = 0;
    double exchanged = 0;
    double last_step = 0; // dt of the last kick [s], 0 before the first
  };
  Ledger ledger_;

  struct Progress // doubles only: it is part of the state
  {
    double has_forces = 0; // 1: those of displacement_of_stress_ are known
    double is_kicked = 0;  // 1 from a kick to its drift
    double n_steps = 0;    // drifts so far
    double time = 0;       // their sum [s]
    double is_rested = 0;  // 1 after rest()
  };
  Progress progress_;

  struct Kick;
  struct KickSums;
  struct Braked;
  Braked brake(const Kick &kick, std::size_t node) const;
  void kick_images(const Kick &kick);
  KickSums kick_nodes(const Kick &kick, std::size_t begin, std::size_t end);
  bool has_moved() const; // since the forces were computed
};

} // namespace bergamo::fe
