#pragma once

#include "coupling/adapter/body_mover.h"
#include "coupling/model/coupling.h"

#include <limits>
#include <vector>

namespace bergamo::driver
{

/// A pressure on a horizontal boundary of a body that moves sideways as a whole. Its area seen from above stays what it
/// was, so the pressure that follows the surface has the vertical forces of a load on the reference area; its others go
/// to the nodes' guides.
class TopPressure final : public coupling::Coupling
{
public:
  /// Errors as fe::boundary_surface() has.
  TopPressure(coupling::BodyMover &body, const dealii::DoFHandler<3, 3> &dof_handler, unsigned int boundary_id);

  void set(const double pressure) { pressure_ = pressure; } ///< of the present step [Pa]
  void apply() override;
  std::vector<const coupling::Mover *> movers() const override { return {&body_}; }
  double stable_step() override { return std::numeric_limits<double>::infinity(); }

  double pressure() const { return pressure_; }
  double force() const { return pressure_ * area_; } ///< downwards [N]
  double sinking() const { return volume_ / area_; } ///< of the boundary, mean [m]
  double work() const { return work_; }              ///< done on the body since the start, trapezoidal [J]

  template <class Visit>
  void visit(Visit &visit)
  {
    visit("top/pressure", last_pressure_);
    visit("top/volume", volume_);
    visit("top/work", work_);
  }

private:
  coupling::BodyMover &body_;
  std::vector<double> unit_; // forces under a unit pressure, by dof [m²]
  double area_ = 0.;         // [m²]
  double pressure_ = 0., last_pressure_ = 0.;
  double volume_ = 0.; // between the boundary's places at the start and at present [m³]
  double work_ = 0.;
};

} // namespace bergamo::driver
