#pragma once

#include "drivers/common/run/placed_intruder.h"
#include "drivers/common/run/state_visitor.h"
#include "drivers/penetration/parameters.h"

#include <memory>
#include <vector>

namespace bergamo::driver
{

/// Sand and the rigid body that is pressed into it: two movers of one model, in contact on the body's triangles.
class Intrusion
{
public:
  /// @param sand with the parameters of the penetration, and with the intruder's surface where it was stored with it
  /// @param height at which the lowest point of the intruder starts [m]
  Intrusion(const PenetrationParameters &parameters, std::unique_ptr<dem::Simulation> sand, double height);

  /// @name One step
  /// @{
  void compute(double time); ///< forces and kick; time since the intruder is there [s]
  void move();
  /// @}

  const dem::Simulation &sand() const { return grains->simulation(); }
  const dem::SurfaceParts &parts() const { return intruder.parts; }
  const Vec3 &start_place(const std::int64_t id) const { return start_places[id]; } ///< of a grain [m]
  double lowest() const { return intruder.mover->body().centre()[2]; }              ///< height of the tip [m]
  double stable_step() const { return model.stable_steps().combined(); }            ///< [s]

  /// Between compute() and move().
  /// @{
  double drive_force() const { return intruder.mover->body().guide_force()[2]; } ///< that keeps the speed, upwards [N]
  double drive_work() const { return intruder.mover->body().work(); }            ///< done by it since the start [J]
  double energy_balance() const; ///< of grains, contacts and all work done on them [J]
  /// @}

  void visit(StateVisitor &visit); ///< all but the grains, which the constructor gets

private:
  const PenetrationParameters &parameters;
  coupling::Model model;
  coupling::GrainsMover *grains = nullptr;
  PlacedIntruder intruder;
  std::vector<Vec3> start_places; // by id [m]
};

} // namespace bergamo::driver
