#pragma once

#include "coupling/adapter/body_mover.h"
#include "coupling/model/coupling.h"
#include "drivers/common/run/state_visitor.h"
#include "fe_dealii/boundary/surface_load.h"

#include <limits>
#include <vector>

namespace bergamo::driver
{

/// A pressure that follows the outer side of a membrane whose faces look inwards.
class LateralPressure final : public coupling::Coupling
{
public:
  /// @param membrane the faces of the body
  LateralPressure(coupling::BodyMover &body, fe::Surface membrane);

  void set(const double pressure) { pressure_ = pressure; } ///< of the present step [Pa]
  void apply() override;
  std::vector<const coupling::Mover *> movers() const override { return {&body_}; }
  double stable_step() override { return std::numeric_limits<double>::infinity(); }

  double pressure() const { return pressure_; }
  double work() const { return work_; } ///< done on the body since the start, trapezoidal [J]

  void visit(StateVisitor &visit);

private:
  coupling::BodyMover &body_;
  fe::SurfaceLoad faces_;
  double pressure_ = 0.;
  std::vector<double> force_, displacement_; // by dof, of the step before [N, m]; empty before the first
  double work_ = 0.;
};

} // namespace bergamo::driver
