#include "drivers/rubber_block/top_pressure.h"

#include "fe_dealii/boundary/surface_load.h"

#include <cstddef>

namespace bergamo::driver
{

TopPressure::TopPressure(coupling::BodyMover &body, const dealii::DoFHandler<3, 3> &dof_handler,
                         const unsigned int boundary_id)
    : Coupling("top pressure"), body_(body), unit_(3 * body.body().n_nodes())
{
  const fe::SurfaceLoad load(fe::boundary_surface(dof_handler, boundary_id), body.body().node_position());
  load.add_traction({0., 0., -1.}, unit_);
  area_ = load.reference_area();
}

void TopPressure::apply()
{
  fe::MovingBody &body = body_.body();
  double volume = 0.;
  for (std::size_t dof = 0; dof < unit_.size(); ++dof)
  {
    body.external_force()[dof] += pressure_ * unit_[dof];
    volume += unit_[dof] * body.displacement()[dof];
  }
  work_ += 0.5 * (last_pressure_ + pressure_) * (volume - volume_);
  volume_ = volume;
  last_pressure_ = pressure_;
}

} // namespace bergamo::driver
