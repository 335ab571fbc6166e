#include "drivers/membrane_triaxial/lateral_pressure.h"

#include <utility>

namespace bergamo::driver
{

LateralPressure::LateralPressure(coupling::BodyMover &body, fe::Surface membrane)
    : Coupling("lateral pressure"), body_(body), faces_(std::move(membrane), body.body().node_position())
{
}

void LateralPressure::apply()
{
  fe::MovingBody &body = body_.body();
  std::vector<double> force(3 * body.n_nodes());
  faces_.add_pressure(-pressure_, body.displacement(), force);
  for (std::size_t dof = 0; dof < force_.size(); ++dof)
    work_ += 0.5 * (force_[dof] + force[dof]) * (body.displacement()[dof] - displacement_[dof]);
  for (std::size_t dof = 0; dof < force.size(); ++dof)
    body.external_force()[dof] += force[dof];
  force_ = std::move(force);
  displacement_.assign(body.displacement().begin(), body.displacement().end());
}

void LateralPressure::visit(StateVisitor &visit)
{
  visit("lateral_pressure/force", force_);
  visit("lateral_pressure/displacement", displacement_);
  visit("lateral_pressure/work", work_);
}

} // namespace bergamo::driver
