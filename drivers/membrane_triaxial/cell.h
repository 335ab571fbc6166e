#pragma once

#include "coupling/adapter/grains_mover.h"
#include "coupling/adapter/surface_contact.h"
#include "coupling/model/model.h"
#include "drivers/common/run/clocked_body.h"
#include "drivers/membrane_triaxial/lateral_pressure.h"
#include "drivers/membrane_triaxial/mould.h"

#include <memory>

namespace bergamo::driver
{

/// Shares of the time that steps have taken, since the process began.
struct CellShares
{
  double grains = 0.;   ///< with their contacts with plates and membrane
  double searches = 0.; ///< of these the searches: of spheres, contacts with the membrane alone are searched
  double elements = 0.; ///< with their nodes
  double coupling = 0.; ///< the surface that follows the membrane, its forces on the nodes, the lateral pressure
};

/// The sample between its plates, in a membrane under the pressure around it. The rims stay on the plates, where they
/// were when the membrane took the mould's place.
class TriaxialCell
{
public:
  /// @param sample as Mould::take() gives it, or stored later on; @param mould when the membrane took its place
  TriaxialCell(const MembraneTriaxialParameters &parameters, std::unique_ptr<dem::Simulation> sample,
               const Prism &mould);

  /// @name One step
  /// @{
  void load(double pressure);                   ///< forces and kick, the plates as pistons under the pressure [Pa]
  void compress(double pressure, double speed); ///< the same, the plates approaching one another [Pa, m/s]
  void move();
  /// @}

  /// Between load() or compress() and move(). @{
  double height() const;                                   ///< between the plates [m]
  double volume() const { return shape.volume(height()); } ///< [m³]
  double section() const { return volume() / height(); }   ///< mean [m²]
  std::vector<double> radii() const { return shape.radii(); }
  double axial_force() const { return plate_force(sample()); } ///< of the plates on the grains [N]
  double membrane_force() const;                               ///< of the plates on the membrane's rims, inwards [N]
  double energy_balance() const;                               ///< of grains, membrane, contacts and all work [J]
  double work() const;                                         ///< of plates, rims, gravity and pressure [J]
  /// @}

  const LateralPressure &pressure() const { return *around; }
  const dem::Simulation &sample() const { return grains->simulation(); }
  const fe::MovingBody &membrane() const { return rubber->body(); }
  double stable_step() const { return model.stable_steps().combined(); } ///< [s]
  CellShares shares() const;

  void visit_membrane(StateVisitor &visit); ///< all but the grains, which the constructor gets

private:
  TriaxialCell(const MembraneTriaxialParameters &parameters, std::unique_ptr<dem::Simulation> sample,
               std::unique_ptr<fe::MembraneBody> membrane, const Prism &mould);
  void compute_forces(double pressure);
  void kick(double plate_speed);

  const MembraneTriaxialParameters &parameters;
  MembraneShape shape;
  coupling::Model model;
  coupling::GrainsMover *grains = nullptr;
  ClockedBody *rubber = nullptr;
  LateralPressure *around = nullptr;
  fe::MovingBody::Constraint lower, upper; // of the rims, upright
  PhaseTimes before;                       // of the grains, in the mould
  double seconds = 0.;                     // of all steps
};

} // namespace bergamo::driver
