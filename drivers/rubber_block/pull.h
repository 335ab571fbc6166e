#pragma once

#include "coupling/adapter/grains_mover.h"
#include "coupling/adapter/surface_contact.h"
#include "coupling/model/model.h"
#include "drivers/common/run/clocked_body.h"
#include "drivers/common/run/state_visitor.h"
#include "drivers/rubber_block/contact_pressure.h"
#include "drivers/rubber_block/parameters.h"
#include "drivers/rubber_block/top_pressure.h"

#include <memory>
#include <optional>

namespace bergamo::driver
{

/// Shares of the time that steps have taken, since the process began.
struct StepShares
{
  double grains = 0.;   ///< the search for their contacts with the block included
  double elements = 0.; ///< with their nodes
  double coupling = 0.; ///< the surface that follows the block, and its forces on the nodes
};

/// The block on the sand: pressed on its top, which is then pulled along x and held along y; upright it is free.
class Pull
{
public:
  /// @param sand with the parameters of the pull, and with the block's surface where it was stored with it
  /// @param height at which the block's bottom starts [m]
  Pull(const RubberBlockParameters &parameters, std::unique_ptr<dem::Simulation> sand, double height);

  /// @name One step
  /// @{
  void compute(double time); ///< forces and kick; time since the block is there [s]
  void move();
  /// @}

  /// Between compute() and move().
  /// @{
  Vec3 contact_force() const { return sand().surface_loads()[surface].force; } ///< of the grains on the block [N]
  double pulling_force() const { return block->body().reaction(guide); }       ///< on the block's top, along x [N]
  void measure_pressure() { pressure_below->measure(sand(), surface); }
  double energy_balance() const; ///< of grains, block, contacts and all work done on them [J]
  double work() const;           ///< of pull and pressure [J]
  /// @}

  double position() const { return body().displacement()[3 * std::size_t(top_node)]; } ///< of the top [m]
  double weight() const { return weight_of_block; }                                    ///< of the block [N]
  const ContactPressure &contact_pressure() const { return *pressure_below; }          ///< of measure_pressure()
  const TopPressure &top() const { return *pressure_above; }
  const dem::Simulation &sand() const { return grains->simulation(); }
  const fe::ExplicitBody &body() const { return *solid; }
  double stable_step() const { return model.stable_steps().combined(); } ///< [s]
  StepShares shares() const;

  void visit_block(StateVisitor &visit); ///< all but the grains, which the constructor gets

private:
  static constexpr std::int32_t surface = 0; // of the simulation

  const RubberBlockParameters &parameters;
  coupling::Model model;
  coupling::GrainsMover *grains = nullptr;
  ClockedBody *block = nullptr;
  const fe::ExplicitBody *solid = nullptr; // the block's
  TopPressure *pressure_above = nullptr;
  std::optional<ContactPressure> pressure_below;
  fe::MovingBody::Constraint guide; // of the top, along x
  unsigned int top_node = 0;
  double weight_of_block = 0.;
  double step;
  double seconds = 0., seconds_of_settling = 0.; // of all steps, and of the grains before
};

} // namespace bergamo::driver
